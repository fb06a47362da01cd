// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/line_reader.h>

#include <string>

namespace osio::exr {

namespace {

/// Without compression a chunk is its lines.
class StoredReader final : public LineReader {
  public:
    using LineReader::LineReader;

  private:
    [[nodiscard]] Result<void> unpack(const exr_chunk_info_t& chunk, std::span<std::uint8_t> lines) override {
        const ExrFile& file = *job().file;
        if (chunk.packed_size != lines.size())
            return fail(ErrorCode::Damaged,
                        "a chunk of " + std::to_string(chunk.packed_size) + " bytes, expected " +
                            std::to_string(lines.size()),
                        file.path());
        const auto code = exr_read_chunk(file.context(), static_cast<int>(job().part), &chunk, lines.data());
        return code == EXR_ERR_SUCCESS ? Result<void>() : core_failure(code, file.path());
    }
};

}  // namespace

std::vector<LineChannel> line_channels(const ExrPart& part, const PlaneChannels& planes) {
    std::vector<LineChannel> out;
    for (const ExrChannel& channel : part.channels)
        out.push_back({channel.type, std::nullopt});
    for (std::size_t plane = 0; plane < planes.size(); ++plane)
        if (planes[plane])
            out[*planes[plane]].plane = plane;
    return out;
}

std::size_t pixel_bytes(const std::vector<LineChannel>& channels) {
    std::size_t bytes = 0;
    for (const LineChannel& channel : channels)
        bytes += sample_bytes(channel.type);
    return bytes;
}

LineReader::LineReader(const BlockJob& job)
    : m_job(job), m_channels(line_channels(job.file->parts()[job.part], job.planes)),
      m_line_bytes(pixel_bytes(m_channels) * static_cast<std::size_t>(job.grid.window.width())),
      m_lines(bytes_needed(job)) {}

std::uint64_t LineReader::bytes_needed(const BlockJob& job) {
    const auto pixels = static_cast<std::uint64_t>(job.grid.window.width()) *
                        static_cast<std::uint64_t>(job.grid.rows_per_block);
    return pixels * pixel_bytes(line_channels(job.file->parts()[job.part], {}));
}

Result<PlanarBlock> LineReader::read(std::size_t block) {
    const int first = m_job.grid.first_row(block), count = m_job.grid.row_count(block);
    for (int row = 0; row < count;) {
        OSIO_TRY(const int rows, read_chunk(first + row, row, count - row));
        row += rows;
    }
    const int width = m_job.grid.window.width();
    PlanarBlock out{first, count, width, std::vector<BandView>(m_job.planes.size()),
                    static_cast<std::ptrdiff_t>(m_line_bytes)};
    const auto* at = reinterpret_cast<const std::byte*>(m_lines.data());
    for (const LineChannel& channel : m_channels) {
        const std::size_t bytes = sample_bytes(channel.type);
        if (channel.plane)
            out.planes[*channel.plane] = {at, channel.type, static_cast<std::ptrdiff_t>(bytes)};
        at += bytes * static_cast<std::size_t>(width);
    }
    return out;
}

/// The chunk that starts at a row, into lines from `line` on; returns how many it has.
Result<int> LineReader::read_chunk(int row, int line, int most_rows) {
    const std::string& path = m_job.file->path();
    exr_chunk_info_t chunk{};
    const auto code =
        exr_read_scanline_chunk_info(m_job.file->context(), static_cast<int>(m_job.part), row, &chunk);
    if (code != EXR_ERR_SUCCESS)
        return core_failure(code, path);
    if (chunk.width != m_job.grid.window.width() || chunk.height <= 0 || chunk.height > most_rows)
        return fail(ErrorCode::Damaged, "a chunk has another size than the header gives it", path);
    const std::span<std::uint8_t> lines = std::span(m_lines).subspan(
        static_cast<std::size_t>(line) * m_line_bytes, static_cast<std::size_t>(chunk.height) * m_line_bytes);
    OSIO_CHECK_OK(unpack(chunk, lines));
    return chunk.height;
}

Result<std::unique_ptr<BlockReader>> make_stored_reader(const BlockJob& job) {
    return std::make_unique<StoredReader>(job);
}

}  // namespace osio::exr
