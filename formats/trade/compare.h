// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/trade/choice.h>

#include <array>
#include <functional>
#include <span>

namespace osio::trade {

/// Some rows as a choice shows them, beside the reference's. All of it lives until the call that hands it out returns.
struct ComparedRows {
    std::size_t choice = 0;  ///< in the list of the choices
    int first_row = 0;
    int row_count = 0;
    std::array<const float*, 3> planes{};  ///< R, G, B of the job's space, row_count x width each
    std::span<const float>
        delta_e;             ///< CIEDE2000, row_count x width; NaN or infinite where there is no colour
    double largest_xyz = 0;  ///< difference of X, Y or Z in these rows, as shares of the white's
};

/// Told of one choice's rows after the other's, in order of rows; one call at a time.
using Spectator = std::function<void(const ComparedRows& rows)>;

/// Makes every choice's colour of every pixel and shows it beside the reference's: one pass over the image. Memory is
/// a block for each choice and worker. The refusals of reading.
[[nodiscard]] Result<void> compare(const image::CollapseJob& job, const Choices& choices, Runner& runner,
                                   const Progress& progress, const Spectator& show);

}  // namespace osio::trade
