// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/line_reader.h>

namespace osio::exr {

LineReader::LineReader(const BlockJob& job)
    : m_job(job), m_channels(line_channels(job.file->parts()[job.part], job.planes)),
      m_line_bytes(pixel_bytes(m_channels) * static_cast<std::size_t>(job.grid.window.width())),
      m_lines(bytes_needed(job)), m_chunk(job) {}

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
    const ChunkShape shape{static_cast<std::size_t>(chunk.width), static_cast<std::size_t>(chunk.height)};
    OSIO_CHECK_OK(m_chunk.unpack(chunk, shape, lines));
    return chunk.height;
}

}  // namespace osio::exr
