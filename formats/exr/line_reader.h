// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/packed_chunk.h>

namespace osio::exr {

/// Unpacks chunks of scanlines into memory of its own and shows the planes where they lie there: what
/// is not needed is not copied.
class LineReader final : public BlockReader {
  public:
    explicit LineReader(const BlockJob& job);

    /// Bytes of the memory.
    [[nodiscard]] static std::uint64_t bytes_needed(const BlockJob& job);

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override;

  private:
    [[nodiscard]] Result<int> read_chunk(int row, int line, int most_rows);

    BlockJob m_job;
    std::vector<LineChannel> m_channels;
    std::size_t m_line_bytes;
    std::vector<std::uint8_t> m_lines;
    PackedChunk m_chunk;
};

}  // namespace osio::exr
