// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/band_view.h>

#include <cstddef>
#include <string>

namespace osio::exr {

/// A channel to be written.
struct OutputChannel {
    std::string name;
    SampleType type = SampleType::Float;
};

/// Pixels across and down.
struct TileSize {
    int width = 0;
    int height = 0;
};

/// Where a channel's samples lie for some rows; samples have the type of the channel.
struct ChannelRows {
    const std::byte* data = nullptr;  ///< first sample of the first row
    std::ptrdiff_t pixel_stride_bytes = 0;
    std::ptrdiff_t row_stride_bytes = 0;
};

}  // namespace osio::exr
