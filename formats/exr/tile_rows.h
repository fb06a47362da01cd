// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/output_rows.h>

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace osio::exr {

/// Rows of pixels on their way into tiles that OpenEXR packs: it takes whole tiles, so rows are kept until a row of
/// tiles is complete.
class TileRows {
  public:
    /// The header has a tile description; channels are in the order of the rows.
    TileRows(const Imf::Header& header, std::vector<OutputChannel> channels);

    /// Takes the rows that follow, and calls `write` for each row of tiles that they complete: its number, and where
    /// its pixels lie.
    void add(std::span<const ChannelRows> channels, int row_count,
             const std::function<void(int tile_row, const Imf::FrameBuffer& pixels)>& write);

  private:
    [[nodiscard]] Imf::FrameBuffer frame_buffer(int first_row, int row_count);

    std::vector<OutputChannel> m_channels;
    std::vector<std::vector<std::byte>> m_planes;
    int m_min_x, m_first_row, m_end_row, m_next_row;
    int m_lines;
    std::size_t m_width;
};

}  // namespace osio::exr
