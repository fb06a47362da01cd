// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>

#include <array>

/// Fewer bands that have the colours of many under the lights and observers that are named.
namespace osio {

/// A light and an observer under which a reduced image must have the colours of the original.
struct Demand {
    CollapsePlan plan;                  ///< of the original's bands, to X, Y, Z
    Vector3 white{};                    ///< X, Y, Z that Lab refers to
    std::array<NmSamples, 3> curves{};  ///< what the plan weighs a spectrum by, at 1 nm

    /// "D65, cie1931"; of radiance "cie1931".
    [[nodiscard]] std::string name() const;
};

/// A demand of a plan to `xyz` without filters. `white_luminance` is Y of the white, in the units of the plan's Y.
[[nodiscard]] Demand make_demand(CollapsePlan plan, double white_luminance);

}  // namespace osio
