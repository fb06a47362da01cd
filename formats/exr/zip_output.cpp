// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/header_output.h>
#include <formats/exr/zip_output.h>

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
      m_end_row(header.dataWindow().max.y + 1),
      m_lines(header.compression() == Imf::ZIP_COMPRESSION ? 16 : 1), m_level(header.zipCompressionLevel()),
      m_width(static_cast<std::size_t>(header.dataWindow().max.x - header.dataWindow().min.x + 1)),
      m_next_row(m_first_row), m_encoder(m_level) {
    std::iota(m_order.begin(), m_order.end(), std::size_t{0});
    std::sort(m_order.begin(), m_order.end(),
              [&](std::size_t a, std::size_t b) { return channels[a].name < channels[b].name; });
    for (const OutputChannel& channel : channels) {
        m_sample_bytes.push_back(sample_bytes(channel.type));
        m_line_bytes += m_sample_bytes.back() * m_width;
    }
    if (m_line_bytes > std::numeric_limits<std::int32_t>::max() / static_cast<std::size_t>(m_lines))
        throw std::runtime_error("a chunk of " + std::to_string(m_lines) + " lines would exceed 2 GB");
}

void ZipOutput::reserve_table() {
    m_table_position = m_stream.tellp();
    const int chunks = (m_end_row - m_first_row + m_lines - 1) / m_lines;
    for (int chunk = 0; chunk < chunks; ++chunk)
        write_number(m_stream, std::uint64_t{0});
}

int ZipOutput::chunk_end(int row) const {
    return std::min(m_end_row, m_first_row + ((row - m_first_row) / m_lines + 1) * m_lines);
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
            const std::size_t before = out.packed.size();
            encoder.encode(samples, out.packed);
            out.chunks.push_back({row, out.packed.size() - before});
        } else {
            (begins ? out.tail_rows : out.head_rows) = stop - row;
        }
        row = stop;
    }
}

void ZipOutput::append(const PackedRows& rows) {
    if (rows.head_rows != 0) {
        const int first_row = m_next_row - m_open_rows;
        m_open.insert(m_open.end(), rows.head.begin(), rows.head.end());
        m_open_rows += rows.head_rows;
        m_next_row += rows.head_rows;
        if (m_next_row == chunk_end(first_row)) {
            std::vector<std::uint8_t> packed;
            m_encoder.encode(m_open, packed);
            write_chunk(first_row, packed);
            m_open.clear();
            m_open_rows = 0;
        }
    }
    std::size_t at = 0;
    for (const PackedRows::Chunk& chunk : rows.chunks) {
        write_chunk(chunk.first_row, std::span(rows.packed).subspan(at, chunk.bytes));
        m_next_row = chunk_end(chunk.first_row);
        at += chunk.bytes;
    }
    if (rows.tail_rows != 0) {
        m_open = rows.tail;
        m_open_rows = rows.tail_rows;
        m_next_row += rows.tail_rows;
    }
}

void ZipOutput::write_chunk(int first_row, std::span<const std::uint8_t> packed) {
    m_table.push_back(m_stream.tellp());
    if (m_part)
        write_number(m_stream, *m_part);
    write_number(m_stream, static_cast<std::uint32_t>(first_row));
    write_number(m_stream, static_cast<std::uint32_t>(packed.size()));
    m_stream.write(reinterpret_cast<const char*>(packed.data()), static_cast<int>(packed.size()));
}

void ZipOutput::finish() {
    m_stream.seekp(m_table_position);
    for (const std::uint64_t position : m_table)
        write_number(m_stream, position);
}

}  // namespace osio::exr
