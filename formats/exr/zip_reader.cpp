// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_reader.h>
#include <formats/exr/line_reader.h>
#include <formats/exr/zip_codec.h>

#include <cstring>
#include <string>
#include <vector>

namespace osio::exr {

namespace {

/// Chunks of a part, packed. One for each worker; memory is reused.
class ZipChunk {
  public:
    explicit ZipChunk(const BlockJob& job) : m_file(*job.file), m_part(static_cast<int>(job.part)) {}

    /// Inflates a chunk that must become `bytes`.
    [[nodiscard]] Result<void> start(const exr_chunk_info_t& chunk, std::size_t bytes) {
        if (chunk.unpacked_size != bytes || chunk.packed_size == 0 || chunk.packed_size > bytes)
            return fail(ErrorCode::Damaged,
                        "a chunk of " + std::to_string(chunk.packed_size) + " packed and " +
                            std::to_string(chunk.unpacked_size) + " unpacked bytes, expected 1 to " +
                            std::to_string(bytes) + " and " + std::to_string(bytes),
                        m_file.path());
        m_packed.resize(chunk.packed_size);
        const auto code = exr_read_chunk(m_file.context(), m_part, &chunk, m_packed.data());
        if (code != EXR_ERR_SUCCESS)
            return core_failure(code, m_file.path());
        if (auto started = m_decoder.start(m_packed, bytes); !started)
            return fail_in(m_file.path(), std::move(started).error());
        return {};
    }

    /// The next of its bytes, whole samples.
    void next(std::span<std::uint8_t> out) { m_decoder.next(out); }

  private:
    const ExrFile& m_file;
    int m_part;
    std::vector<std::uint8_t> m_packed;
    ZipDecoder m_decoder;
};

class ZipLineReader final : public LineReader {
  public:
    explicit ZipLineReader(const BlockJob& job) : LineReader(job), m_chunk(job) {}

  private:
    [[nodiscard]] Result<void> unpack(const exr_chunk_info_t& chunk, std::span<std::uint8_t> lines) override {
        OSIO_CHECK_OK(m_chunk.start(chunk, lines.size()));
        m_chunk.next(lines);
        return {};
    }

    ZipChunk m_chunk;
};

class ZipTileReader final : public ChunkReader {
  public:
    explicit ZipTileReader(const BlockJob& job)
        : ChunkReader(job), m_chunk(job), m_channels(line_channels(part(), job.planes)),
          m_pixel_bytes(pixel_bytes(m_channels)) {}

  private:
    [[nodiscard]] Result<void> decode(const exr_chunk_info_t& chunk, const Place& place) override {
        m_line.resize(m_pixel_bytes * static_cast<std::size_t>(place.width));
        OSIO_CHECK_OK(m_chunk.start(chunk, m_line.size() * static_cast<std::size_t>(place.height)));
        for (int row = 0; row < place.height; ++row) {
            m_chunk.next(m_line);
            copy_line(place, row);
        }
        return {};
    }

    void copy_line(const Place& place, int row) {
        const std::uint8_t* from = m_line.data();
        for (const LineChannel& channel : m_channels) {
            const std::size_t bytes = sample_bytes(channel.type) * static_cast<std::size_t>(place.width);
            if (channel.plane)
                std::memcpy(target(*channel.plane, sample_bytes(channel.type), place, row), from, bytes);
            from += bytes;
        }
    }

    ZipChunk m_chunk;
    std::vector<LineChannel> m_channels;
    std::size_t m_pixel_bytes;
    std::vector<std::uint8_t> m_line;
};

}  // namespace

Result<std::unique_ptr<BlockReader>> make_zip_reader(const BlockJob& job) {
    if (job.file->parts()[job.part].tiled)
        return std::make_unique<ZipTileReader>(job);
    return std::make_unique<ZipLineReader>(job);
}

}  // namespace osio::exr
