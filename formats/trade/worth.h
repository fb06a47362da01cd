// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/trade/choice.h>

#include <cstdint>
#include <vector>

namespace osio::trade {

/// How far a choice is from the reference, over all pixels: CIEDE2000, and X, Y, Z. Numbers only: statistics of 8 MB
/// for each choice would be part of every peak of memory that is measured while they are held.
struct Worth {
    double delta_e_mean = 0;
    double delta_e_95 = 0;  ///< percentiles, as of ValueStatistics
    double delta_e_99_9 = 0;
    double delta_e_max = 0;
    std::uint64_t undefined_pixels = 0;  ///< without a colour, NaN or infinite, which enter nothing else
    double largest_xyz = 0;              ///< of X, Y and Z as shares of the white's
};

/// Makes every choice's colour of every pixel and compares it with the reference's: one pass over the image. In the
/// order of the choices.
[[nodiscard]] Result<std::vector<Worth>> worth_of(const image::CollapseJob& job, const Choices& choices,
                                                  Runner& runner, const Progress& progress);

}  // namespace osio::trade
