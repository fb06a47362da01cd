// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_reader.h>
#include <formats/exr/zip_codec.h>

#include <cstring>
#include <string>
#include <vector>

namespace osio::exr {

namespace {

/// A channel in a line of a chunk: the file's channels follow each other, each a run of samples.
struct LineChannel {
    std::size_t sample_bytes = 0;
    std::optional<std::size_t> plane;  ///< where it goes; nothing where nobody reads it
};

std::vector<LineChannel> line_of(const ExrPart& part, const PlaneChannels& planes) {
    std::vector<LineChannel> out;
    for (const ExrChannel& channel : part.channels)
        out.push_back({sample_bytes(channel.type), std::nullopt});
    for (std::size_t plane = 0; plane < planes.size(); ++plane)
        if (planes[plane])
            out[*planes[plane]].plane = plane;
    return out;
}

class ZipReader final : public ChunkReader {
  public:
    explicit ZipReader(const BlockJob& job)
        : ChunkReader(job), m_line(line_of(part(), job.planes)), m_pixel_bytes(0) {
        for (const LineChannel& channel : m_line)
            m_pixel_bytes += channel.sample_bytes;
    }

  private:
    [[nodiscard]] Result<void> decode(const exr_chunk_info_t& chunk, const Place& place) override {
        const std::uint64_t bytes = m_pixel_bytes * static_cast<std::uint64_t>(place.width) *
                                    static_cast<std::uint64_t>(place.height);
        if (chunk.unpacked_size != bytes || chunk.packed_size == 0 || chunk.packed_size > bytes)
            return fail(ErrorCode::Damaged,
                        "a chunk of " + std::to_string(chunk.packed_size) + " packed and " +
                            std::to_string(chunk.unpacked_size) + " unpacked bytes, expected 1 to " +
                            std::to_string(bytes) + " and " + std::to_string(bytes),
                        path());
        m_packed.resize(chunk.packed_size);
        const auto code = exr_read_chunk(context(), part_index(), &chunk, m_packed.data());
        if (code != EXR_ERR_SUCCESS)
            return core_failure(code, path());
        if (auto started = m_decoder.start(m_packed, bytes); !started)
            return fail_in(path(), std::move(started).error());
        for (int row = 0; row < place.height; ++row)
            copy_line(place, row);
        return {};
    }

    void copy_line(const Place& place, int row) {
        const auto width = static_cast<std::size_t>(place.width);
        const std::uint8_t* from = m_decoder.next(m_pixel_bytes * width).data();
        for (const LineChannel& channel : m_line) {
            const std::size_t bytes = channel.sample_bytes * width;
            if (channel.plane)
                std::memcpy(target(*channel.plane, channel.sample_bytes, place, row), from, bytes);
            from += bytes;
        }
    }

    std::vector<LineChannel> m_line;
    std::size_t m_pixel_bytes;
    std::vector<std::uint8_t> m_packed;
    ZipDecoder m_decoder;
};

}  // namespace

Result<std::unique_ptr<BlockReader>> make_zip_reader(const BlockJob& job) {
    return std::make_unique<ZipReader>(job);
}

}  // namespace osio::exr
