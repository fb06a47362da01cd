// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <string>

namespace osio::tool {

/// A plan as an SVG picture over 360-830 nm: the light with its filters, the bands, their weights for every output, and
/// below them the error budget of greys with what other bases would differ by.
[[nodiscard]] std::string plan_plot(const image::CollapseJob& job);

}  // namespace osio::tool
