// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/exr_file.h>
#include <formats/exr/tile_rows.h>

#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <cstring>

namespace osio::exr {

TileRows::TileRows(const Imf::Header& header, std::vector<OutputChannel> channels)
    : m_channels(std::move(channels)), m_planes(m_channels.size()), m_min_x(header.dataWindow().min.x),
      m_first_row(header.dataWindow().min.y), m_end_row(header.dataWindow().max.y + 1),
      m_next_row(m_first_row), m_lines(static_cast<int>(header.tileDescription().ySize)),
      m_width(static_cast<std::size_t>(header.dataWindow().max.x - m_min_x + 1)) {}

void TileRows::add(std::span<const ChannelRows> channels, int row_count,
                   const std::function<void(int, const Imf::FrameBuffer&)>& write) {
    for (int row = 0; row < row_count; ++row) {
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const std::byte* from = channels[c].data + channels[c].row_stride_bytes * row;
            const std::size_t bytes = sample_bytes(m_channels[c].type);
            std::vector<std::byte>& plane = m_planes[c];
            const std::size_t at = plane.size();
            plane.resize(at + m_width * bytes);
            for (std::size_t x = 0; x < m_width; ++x, from += channels[c].pixel_stride_bytes)
                std::memcpy(plane.data() + at + x * bytes, from, bytes);
        }
        ++m_next_row;
        const int tile_row = (m_next_row - 1 - m_first_row) / m_lines;
        const int begin = m_first_row + tile_row * m_lines;
        if (m_next_row != m_end_row && m_next_row - begin != m_lines)
            continue;
        write(tile_row, frame_buffer(begin, m_next_row - begin));
        for (std::vector<std::byte>& plane : m_planes)
            plane.clear();
    }
}

Imf::FrameBuffer TileRows::frame_buffer(int first_row, int row_count) {
    Imf::FrameBuffer out;
    for (std::size_t c = 0; c < m_channels.size(); ++c)
        out.insert(m_channels[c].name,
                   Imf::Slice::Make(pixel_type(m_channels[c].type), m_planes[c].data(),
                                    Imath::V2i(m_min_x, first_row), static_cast<int>(m_width), row_count));
    return out;
}

}  // namespace osio::exr
