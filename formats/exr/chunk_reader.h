// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_buffer.h>
#include <formats/exr/block_readers.h>

#include <OpenEXR/openexr_chunkio.h>

#include <string>

namespace osio::exr {

/// Where a chunk's pixels go in the block.
struct Place {
    int column = 0;
    int row = 0;
    int width = 0;  ///< pixels that the grid expects
    int height = 0;
};

/// Finds a block's chunks by OpenEXRCore and checks their sizes; how they are decoded is left open.
class ChunkReader : public BlockReader {
  public:
    explicit ChunkReader(const BlockJob& job);

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) final;

  protected:
    /// Decodes a chunk, whose width and height are those of `place`, into buffer().
    [[nodiscard]] virtual Result<void> decode(const exr_chunk_info_t& chunk, const Place& place) = 0;

    [[nodiscard]] const BlockJob& job() const { return m_job; }

    [[nodiscard]] const image::Part& part() const { return m_part; }

    [[nodiscard]] exr_const_context_t context() const { return m_job.file->context(); }

    [[nodiscard]] int part_index() const { return static_cast<int>(m_job.part); }

    [[nodiscard]] const std::string& path() const { return m_job.file->path(); }

    /// Where a row of a place starts in a plane that is read.
    [[nodiscard]] std::byte* target(std::size_t plane, std::size_t sample_bytes, const Place& place, int row);

  private:
    [[nodiscard]] Result<void> read_scanlines(int first, int count);
    [[nodiscard]] Result<void> read_tiles(int tile_row, int count);
    [[nodiscard]] Result<void> decode_checked(const exr_chunk_info_t& chunk, const Place& place);

    BlockJob m_job;
    const image::Part& m_part;
    BlockBuffer m_buffer;
};

}  // namespace osio::exr
