// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/page_rows.h>

#include <algorithm>
#include <bit>

namespace osio::tiff {

namespace {

/// What floats are made of: rows of a strip or tile that lie in memory.
struct Stored {
    const std::byte* bytes = nullptr;
    std::uint32_t row = 0;          ///< of the page, that is the first
    std::size_t row_numbers = 0;    ///< from a row to the next
    std::size_t pixel_numbers = 0;  ///< from a pixel to the next
    bool big_endian = false;
};

/// Rows first to first + count - 1 of some columns of a sample.
void convert(const Page& page, const Stored& stored, std::uint32_t first, std::uint32_t count,
             std::uint32_t column, std::uint32_t columns, std::size_t sample, const WantedSample& wanted,
             std::uint32_t plane_first) {
    const std::size_t bytes = image::number_bytes(page.type);
    const auto from = [&](std::uint32_t row) {
        return stored.bytes + ((row - stored.row) * stored.row_numbers + sample) * bytes;
    };
    const auto to = [&](std::uint32_t row) {
        return wanted.to + std::size_t{row - plane_first} * page.width + column;
    };
    if (columns == page.width && stored.row_numbers == std::size_t{columns} * stored.pixel_numbers) {
        image::to_floats(from(first), stored.pixel_numbers, std::size_t{count} * columns, page.type,
                         stored.big_endian, *wanted.scaling, to(first));
        return;
    }
    for (std::uint32_t row = first; row < first + count; ++row)
        image::to_floats(from(row), stored.pixel_numbers, columns, page.type, stored.big_endian,
                         *wanted.scaling, to(row));
}

std::string name_of(const Page& page, std::uint32_t index) {
    return (page.tiled ? "tile " : "strip ") + std::to_string(index);
}

}  // namespace

Result<void> PageRows::read(const Page& page, std::uint32_t first, std::uint32_t count,
                            std::span<const WantedSample> wanted) {
    OSIO_CHECK_OK(m_handle->go_to(page.directory));
    const std::uint32_t across = (page.width + page.block_width - 1) / page.block_width;
    const std::uint32_t down = (page.height + page.block_height - 1) / page.block_height;
    for (std::uint32_t y = first / page.block_height; y <= (first + count - 1) / page.block_height; ++y)
        for (std::uint32_t x = 0; x < across; ++x) {
            Block block{y * across + x, y * page.block_height, 0, x * page.block_width, 0};
            block.rows = std::min(page.block_height, page.height - block.row);
            block.columns = std::min(page.block_width, page.width - block.column);
            const auto read_block = page.plain ? &PageRows::read_plain : &PageRows::read_packed;
            if (!page.planar) {
                OSIO_CHECK_OK((this->*read_block)(page, block, first, count, wanted));
                continue;
            }
            const std::uint32_t index = block.index;
            for (const WantedSample& sample : wanted) {
                block.index = index + sample.sample * across * down;
                OSIO_CHECK_OK((this->*read_block)(page, block, first, count, {&sample, 1}));
            }
        }
    return {};
}

Result<void> PageRows::read_plain(const Page& page, const Block& block, std::uint32_t first,
                                  std::uint32_t count, std::span<const WantedSample> wanted) {
    int failed = 0;
    const std::uint64_t offset = TIFFGetStrileOffsetWithErr(m_handle->get(), block.index, &failed);
    OSIO_CHECK_OK(m_handle->check(failed == 0, name_of(page, block.index) + " has no place in the file"));
    const std::uint64_t stored = TIFFGetStrileByteCountWithErr(m_handle->get(), block.index, &failed);
    OSIO_CHECK_OK(m_handle->check(failed == 0, name_of(page, block.index) + " has no size"));
    const std::uint32_t from = std::max(first, block.row);
    const std::uint32_t rows = std::min(first + count, block.row + block.rows) - from;
    const std::uint64_t row_bytes = page.block_bytes(1);
    if (offset == 0 || stored < block.rows * row_bytes)
        return fail(ErrorCode::Damaged, name_of(page, block.index) + " has " + std::to_string(stored) +
                                            " bytes, expected " + std::to_string(block.rows * row_bytes));
    m_bytes.resize(rows * row_bytes);
    OSIO_CHECK_OK(
        m_handle->file().read(offset + (from - block.row) * row_bytes, m_bytes.size(), m_bytes.data()));
    const std::size_t pixel_numbers = page.planar ? 1 : page.samples;
    for (const WantedSample& sample : wanted)
        convert(page, {m_bytes.data(), from, page.width * pixel_numbers, pixel_numbers, page.big_endian},
                from, rows, 0, page.width, page.planar ? 0 : sample.sample, sample, first);
    return {};
}

Result<void> PageRows::read_packed(const Page& page, const Block& block, std::uint32_t first,
                                   std::uint32_t count, std::span<const WantedSample> wanted) {
    const std::uint64_t bytes = page.block_bytes(page.tiled ? page.block_height : block.rows);
    m_bytes.resize(bytes);
    const auto size = static_cast<tmsize_t>(bytes);
    const tmsize_t got = page.tiled
                             ? TIFFReadEncodedTile(m_handle->get(), block.index, m_bytes.data(), size)
                             : TIFFReadEncodedStrip(m_handle->get(), block.index, m_bytes.data(), size);
    OSIO_CHECK_OK(m_handle->check(got == size, name_of(page, block.index) + " cannot be unpacked"));
    const std::uint32_t from = std::max(first, block.row);
    const std::uint32_t rows = std::min(first + count, block.row + block.rows) - from;
    const std::size_t pixel_numbers = page.planar ? 1 : page.samples;
    constexpr bool kBig = std::endian::native == std::endian::big;  // libtiff has swapped
    for (const WantedSample& sample : wanted)
        convert(page, {m_bytes.data(), block.row, page.block_width * pixel_numbers, pixel_numbers, kBig},
                from, rows, block.column, block.columns, page.planar ? 0 : sample.sample, sample, first);
    return {};
}

}  // namespace osio::tiff
