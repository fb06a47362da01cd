// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_readers.h>
#include <formats/exr/chunk_codec.h>

#include <OpenEXR/openexr_chunkio.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace osio::exr {

/// A channel in a line of an unpacked chunk.
struct LineChannel {
    SampleType type = SampleType::Float;
    std::optional<std::size_t> plane;  ///< which plane it is; nothing where nobody reads it
};

/// The channels of a part without sub-sampled ones, in the order of the file.
[[nodiscard]] std::vector<LineChannel> line_channels(const image::Part& part, const PlaneChannels& planes);

/// Bytes of a pixel of all channels.
[[nodiscard]] std::size_t pixel_bytes(const std::vector<LineChannel>& channels);

/// Reads and unpacks the chunks of a part. One for each worker; memory is reused.
class PackedChunk {
  public:
    explicit PackedChunk(const BlockJob& job);

    /// Fills `lines`, which has the size that the shape needs.
    [[nodiscard]] Result<void> unpack(const exr_chunk_info_t& chunk, ChunkShape shape,
                                      std::span<std::uint8_t> lines);

  private:
    std::shared_ptr<const ExrFile> m_file;
    int m_part;
    std::unique_ptr<ChunkCodec> m_codec;
    std::vector<std::uint8_t> m_packed;
};

}  // namespace osio::exr
