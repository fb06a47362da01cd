// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_reader.h>
#include <formats/exr/line_reader.h>

#include <cstring>

namespace osio::exr {

namespace {

class TileReader final : public ChunkReader {
  public:
    explicit TileReader(const BlockJob& job)
        : ChunkReader(job), m_chunk(job), m_channels(line_channels(part(), job.planes)),
          m_pixel_bytes(pixel_bytes(m_channels)) {}

  private:
    [[nodiscard]] Result<void> decode(const exr_chunk_info_t& chunk, const Place& place) override {
        const ChunkShape shape{static_cast<std::size_t>(place.width), static_cast<std::size_t>(place.height)};
        m_lines.resize(m_pixel_bytes * shape.width * shape.height);
        OSIO_CHECK_OK(m_chunk.unpack(chunk, shape, m_lines));
        const std::uint8_t* from = m_lines.data();
        for (int row = 0; row < place.height; ++row)
            for (const LineChannel& channel : m_channels) {
                const std::size_t bytes = sample_bytes(channel.type) * shape.width;
                if (channel.plane)
                    std::memcpy(target(*channel.plane, sample_bytes(channel.type), place, row), from, bytes);
                from += bytes;
            }
        return {};
    }

    PackedChunk m_chunk;
    std::vector<LineChannel> m_channels;
    std::size_t m_pixel_bytes;
    std::vector<std::uint8_t> m_lines;
};

}  // namespace

Result<std::unique_ptr<BlockReader>> make_own_reader(const BlockJob& job) {
    if (job.file->parts()[job.part].tiled)
        return std::make_unique<TileReader>(job);
    return std::make_unique<LineReader>(job);
}

}  // namespace osio::exr
