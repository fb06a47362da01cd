// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_reader.h>

#include <OpenEXR/openexr_part.h>

#include <algorithm>

namespace osio::exr {

ChunkReader::ChunkReader(const BlockJob& job)
    : m_job(job), m_part(job.file->parts()[job.part]), m_buffer(m_part, job.planes, job.grid) {}

Result<PlanarBlock> ChunkReader::read(std::size_t block) {
    const int first = m_job.grid.first_row(block);
    const int count = m_job.grid.row_count(block);
    if (m_part.tiled)
        OSIO_CHECK_OK(read_tiles(static_cast<int>(block), count));
    else
        OSIO_CHECK_OK(read_scanlines(first, count));
    return m_buffer.block(first, count);
}

std::byte* ChunkReader::target(std::size_t plane, std::size_t bytes, const Place& place, int row) {
    const auto width = static_cast<std::size_t>(m_job.grid.window.width());
    return m_buffer.plane(plane) +
           (static_cast<std::size_t>(place.row + row) * width + static_cast<std::size_t>(place.column)) *
               bytes;
}

Result<void> ChunkReader::read_scanlines(int first, int count) {
    for (int row = 0; row < count;) {
        exr_chunk_info_t chunk{};
        const auto code = exr_read_scanline_chunk_info(context(), part_index(), first + row, &chunk);
        if (code != EXR_ERR_SUCCESS)
            return core_failure(code, path());
        const Place place{0, row, m_job.grid.window.width(), std::min(chunk.height, count - row)};
        OSIO_CHECK_OK(decode_checked(chunk, place));
        row += chunk.height;
    }
    return {};
}

Result<void> ChunkReader::read_tiles(int tile_row, int count) {
    int32_t tile_width = 0, tile_height = 0;
    const auto code = exr_get_tile_sizes(context(), part_index(), 0, 0, &tile_width, &tile_height);
    if (code != EXR_ERR_SUCCESS)
        return core_failure(code, path());
    if (tile_width <= 0)
        return fail(ErrorCode::Damaged, "tiles of no columns", path());
    // Core reports the largest tile of the level, which is no wider than the image.
    for (int column = 0; column < m_job.grid.window.width(); column += tile_width) {
        exr_chunk_info_t chunk{};
        const auto found =
            exr_read_tile_chunk_info(context(), part_index(), column / tile_width, tile_row, 0, 0, &chunk);
        if (found != EXR_ERR_SUCCESS)
            return core_failure(found, path());
        const int width = std::min(tile_width, m_job.grid.window.width() - column);
        OSIO_CHECK_OK(decode_checked(chunk, {column, 0, width, count}));
    }
    return {};
}

Result<void> ChunkReader::decode_checked(const exr_chunk_info_t& chunk, const Place& place) {
    if (chunk.width != place.width || chunk.height != place.height || chunk.height <= 0)
        return fail(ErrorCode::Damaged, "a chunk has another size than the header gives it", path());
    return decode(chunk, place);
}

}  // namespace osio::exr
