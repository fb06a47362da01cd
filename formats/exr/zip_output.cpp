// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/header_output.h>
#include <formats/exr/zip_output.h>

#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace osio::exr {

namespace {

template <std::size_t kBytes>
void copy_samples(const std::byte* from, std::ptrdiff_t stride, std::size_t count, std::uint8_t* to) {
    if (stride == static_cast<std::ptrdiff_t>(kBytes)) {
        std::memcpy(to, from, count * kBytes);
        return;
    }
    for (std::size_t i = 0; i < count; ++i, from += stride, to += kBytes)
        std::memcpy(to, from, kBytes);
}

}  // namespace

bool ZipOutput::can_write(const Imf::Header& header) {
    return header.compression() == Imf::ZIP_COMPRESSION || header.compression() == Imf::ZIPS_COMPRESSION;
}

ZipOutput::ZipOutput(Imf::OStream& stream, const Imf::Header& header, std::span<const OutputChannel> channels,
                     std::optional<std::uint32_t> part)
    : m_stream(stream), m_part(part), m_order(channels.size()), m_first_row(header.dataWindow().min.y),
      m_end_row(header.dataWindow().max.y + 1), m_lines(static_cast<int>(header_chunk(header).height)),
      m_level(header.zipCompressionLevel()),
      m_width(static_cast<std::size_t>(header.dataWindow().max.x - header.dataWindow().min.x + 1)),
      m_next_row(m_first_row), m_encoder(m_level) {
    std::iota(m_order.begin(), m_order.end(), std::size_t{0});
    std::sort(m_order.begin(), m_order.end(),
              [&](std::size_t a, std::size_t b) { return channels[a].name < channels[b].name; });
    for (const OutputChannel& channel : channels) {
        m_sample_bytes.push_back(sample_bytes(channel.type));
        m_line_bytes += m_sample_bytes.back() * m_width;
    }
    std::size_t chunk_line_bytes = m_line_bytes;
    if (header.hasTileDescription()) {
        m_tile_width = std::min<std::size_t>(header.tileDescription().xSize, m_width);
        m_columns = static_cast<int>((m_width + m_tile_width - 1) / m_tile_width);
        chunk_line_bytes = m_line_bytes / m_width * m_tile_width;
    }
    const auto lines = static_cast<std::size_t>(std::min(m_lines, m_end_row - m_first_row));
    if (chunk_line_bytes > std::numeric_limits<std::int32_t>::max() / lines)
        throw std::runtime_error("a chunk of " + std::to_string(lines) + " lines would exceed 2 GB");
}

void ZipOutput::reserve_table() {
    m_table_position = m_stream.tellp();
    const std::int64_t rows = std::int64_t{m_end_row} - m_first_row;
    const std::int64_t chunks = (rows + m_lines - 1) / m_lines * m_columns;
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
        write_number(m_stream, std::uint64_t{0});
}

int ZipOutput::chunk_end(int row) const {
    const std::int64_t end = m_first_row + (std::int64_t{row - m_first_row} / m_lines + 1) * m_lines;
    return static_cast<int>(std::min<std::int64_t>(m_end_row, end));
}

void ZipOutput::gather(int row, std::span<const ChannelRows> channels, int first_row,
                       std::uint8_t* out) const {
    for (const std::size_t c : m_order) {
        const ChannelRows& rows = channels[c];
        const std::byte* from = rows.data + rows.row_stride_bytes * (row - first_row);
        if (m_sample_bytes[c] == 2)
            copy_samples<2>(from, rows.pixel_stride_bytes, m_width, out);
        else
            copy_samples<4>(from, rows.pixel_stride_bytes, m_width, out);
        out += m_sample_bytes[c] * m_width;
    }
}

void ZipOutput::pack(int first_row, int row_count, std::span<const ChannelRows> channels, ZipEncoder& encoder,
                     PackedRows& out) const {
    out.head.clear(), out.tail.clear(), out.chunks.clear(), out.packed.clear();
    out.head_rows = out.tail_rows = 0;
    const int end = first_row + row_count;
    for (int row = first_row; row < end;) {
        const int stop = std::min(chunk_end(row), end);
        const bool begins = (row - m_first_row) % m_lines == 0;
        const bool whole = begins && stop == chunk_end(row);
        std::vector<std::uint8_t>& samples = whole ? out.samples : begins ? out.tail : out.head;
        samples.resize(static_cast<std::size_t>(stop - row) * m_line_bytes);
        for (int line = row; line < stop; ++line)
            gather(line, channels, first_row,
                   samples.data() + static_cast<std::size_t>(line - row) * m_line_bytes);
        if (whole) {
            encode(row, samples, encoder, out.tile, out.chunks, out.packed);
        } else {
            (begins ? out.tail_rows : out.head_rows) = stop - row;
        }
        row = stop;
    }
}

void ZipOutput::encode(int first_row, std::span<const std::uint8_t> lines, ZipEncoder& encoder,
                       std::vector<std::uint8_t>& tile, std::vector<PackedRows::Chunk>& chunks,
                       std::vector<std::uint8_t>& packed) const {
    for (int column = 0; column < m_columns; ++column) {
        const std::size_t before = packed.size();
        if (m_tile_width == 0) {
            encoder.encode(lines, packed);
        } else {
            gather_tile(column, lines, tile);
            encoder.encode(tile, packed);
        }
        chunks.push_back({first_row, column, packed.size() - before});
    }
}

void ZipOutput::gather_tile(int column, std::span<const std::uint8_t> lines,
                            std::vector<std::uint8_t>& tile) const {
    const std::size_t first = static_cast<std::size_t>(column) * m_tile_width;
    const std::size_t width = std::min(m_tile_width, m_width - first);
    tile.resize(lines.size() / m_width * width);
    std::uint8_t* out = tile.data();
    for (const std::uint8_t* line = lines.data(); line < lines.data() + lines.size();)
        for (const std::size_t c : m_order) {
            std::memcpy(out, line + first * m_sample_bytes[c], width * m_sample_bytes[c]);
            out += width * m_sample_bytes[c];
            line += m_width * m_sample_bytes[c];
        }
}

void ZipOutput::append(const PackedRows& rows) {
    if (rows.head_rows != 0) {
        const int first_row = m_next_row - m_open_rows;
        m_open.insert(m_open.end(), rows.head.begin(), rows.head.end());
        m_open_rows += rows.head_rows;
        m_next_row += rows.head_rows;
        if (m_next_row == chunk_end(first_row)) {
            std::vector<PackedRows::Chunk> chunks;
            std::vector<std::uint8_t> packed, tile;
            encode(first_row, m_open, m_encoder, tile, chunks, packed);
            write_chunks(chunks, packed);
            m_open.clear();
            m_open_rows = 0;
        }
    }
    write_chunks(rows.chunks, rows.packed);
    if (!rows.chunks.empty())
        m_next_row = chunk_end(rows.chunks.back().first_row);
    if (rows.tail_rows != 0) {
        m_open = rows.tail;
        m_open_rows = rows.tail_rows;
        m_next_row += rows.tail_rows;
    }
}

void ZipOutput::write_chunks(std::span<const PackedRows::Chunk> chunks,
                             std::span<const std::uint8_t> packed) {
    std::size_t at = 0;
    for (const PackedRows::Chunk& chunk : chunks) {
        m_table.push_back(m_stream.tellp());
        if (m_part)
            write_number(m_stream, *m_part);
        if (m_tile_width == 0) {
            write_number(m_stream, static_cast<std::uint32_t>(chunk.first_row));
        } else {
            write_number(m_stream, static_cast<std::uint32_t>(chunk.column));
            write_number(m_stream, static_cast<std::uint32_t>((chunk.first_row - m_first_row) / m_lines));
            write_number(m_stream, std::uint64_t{0});  // the level, in two directions
        }
        write_number(m_stream, static_cast<std::uint32_t>(chunk.bytes));
        m_stream.write(reinterpret_cast<const char*>(packed.data() + at), static_cast<int>(chunk.bytes));
        at += chunk.bytes;
    }
}

void ZipOutput::finish() {
    m_stream.seekp(m_table_position);
    for (const std::uint64_t position : m_table)
        write_number(m_stream, position);
}

}  // namespace osio::exr
