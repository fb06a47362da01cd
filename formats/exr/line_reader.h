// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_readers.h>

#include <osio/collapse/band_view.h>

#include <OpenEXR/openexr_chunkio.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace osio::exr {

/// A channel in a line of an unpacked chunk: the file's channels follow each other, each a run of
/// samples.
struct LineChannel {
    SampleType type = SampleType::Float;
    std::optional<std::size_t> plane;  ///< which plane it is; nothing where nobody reads it
};

/// The channels of a part without sub-sampled ones, in the order of the file.
[[nodiscard]] std::vector<LineChannel> line_channels(const ExrPart& part, const PlaneChannels& planes);

/// Bytes of a pixel of all channels.
[[nodiscard]] std::size_t pixel_bytes(const std::vector<LineChannel>& channels);

/// Unpacks chunks of scanlines into memory of its own and shows the planes where they lie there: what
/// is not needed is not copied. How a chunk is unpacked is left open.
class LineReader : public BlockReader {
  public:
    explicit LineReader(const BlockJob& job);

    /// Bytes of the memory.
    [[nodiscard]] static std::uint64_t bytes_needed(const BlockJob& job);

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) final;

  protected:
    /// Fills `lines`, which has the size that a chunk of so many lines must have.
    [[nodiscard]] virtual Result<void> unpack(const exr_chunk_info_t& chunk,
                                              std::span<std::uint8_t> lines) = 0;

    [[nodiscard]] const BlockJob& job() const { return m_job; }

  private:
    [[nodiscard]] Result<int> read_chunk(int row, int line, int most_rows);

    BlockJob m_job;
    std::vector<LineChannel> m_channels;
    std::size_t m_line_bytes;
    std::vector<std::uint8_t> m_lines;
};

}  // namespace osio::exr
