// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/trade/choice.h>

#include <osio/base/value_statistics.h>

#include <cstdint>
#include <vector>

namespace osio::trade {

/// How far a choice is from the reference, over all pixels.
struct Worth {
    ValueStatistics delta_e;  ///< CIEDE2000
    double largest_xyz = 0;   ///< of X, Y and Z as shares of the white's
};

/// Makes every choice's colour of every pixel and compares it with the reference's: one pass over the image. In the
/// order of the choices. Undefined pixels are counted by the statistics.
[[nodiscard]] Result<std::vector<Worth>> worth_of(const image::CollapseJob& job, const Choices& choices,
                                                  Runner& runner, const Progress& progress);

}  // namespace osio::trade
