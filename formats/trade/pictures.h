// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/block_grid.h>
#include <formats/trade/choice.h>

#include <cstdint>
#include <vector>

namespace osio::trade {

/// How an image looks under a choice, and how wrong it is there: a number for each square of a grid, row after row.
struct Picture {
    std::vector<std::uint8_t> srgb;  ///< red, green, blue of the squares' mean light; black without any
    std::size_t clipped = 0;         ///< squares with a value that 8 bits of sRGB do not reach
    std::vector<float> delta_e;      ///< largest CIEDE2000 of a square's pixels; NaN where none has a colour
};

/// The choices' pictures, in their order, by one more comparison of every pixel. White is that of the job's space
/// carried to D65 by Bradford (by X, Y, Z where that has nothing to scale), as bright as `white_luminance` of
/// make_choices() says. Memory is 20 bytes for each square and choice. The refusals of reading.
[[nodiscard]] Result<std::vector<Picture>> pictures_of(const image::CollapseJob& job, const Choices& choices,
                                                       const image::BlockGrid& grid, Runner& runner,
                                                       const Progress& progress);

}  // namespace osio::trade
