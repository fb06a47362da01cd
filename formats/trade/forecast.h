// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>
#include <formats/trade/timed_run.h>

#include <cstddef>
#include <vector>

namespace osio::trade {

/// What a collapse into an EXR of floats would take.
struct CollapseForecast {
    Forecast forecast;
    /// Columns of the plan that were zero in every row that was run. Where a column is zero all along a block, it is
    /// left out of the block's sums.
    std::vector<std::size_t> zero_columns;
};

/// Collapses strips of the image into a temporary file: see forecast_run(). The errors of reading and writing.
[[nodiscard]] Result<CollapseForecast> forecast_collapse(const image::CollapseJob& job, Runner& runner,
                                                         const Progress& progress);

}  // namespace osio::trade
