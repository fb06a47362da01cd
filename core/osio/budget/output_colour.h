// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>
#include <osio/collapse/plan.h>

namespace osio {

/// What the sums of a plan are as colours.
struct OutputColour {
    /// X, Y, Z as shares of the white's, of the plan's outputs. Of a single output, luminance, the shares of
    /// a grey.
    Matrix3 share_from_output;
    bool achromatic = false;  ///< one output: greys, whose errors in X, Y and Z are the same share
    Vector3 white{};          ///< X, Y, Z of the white, Y = 1; of greys none
};

/// The colours of a plan's sums, before a curve. `white_luminance` is Y of the white, in the units of the
/// plan's Y. Usage for outputs that have no XYZ (cameras), are no sums (Lab, Luv, chromaticities) or
/// belong to a colour config; InvalidGrid for a white without X or Z.
[[nodiscard]] Result<OutputColour> output_colour(const CollapsePlan& plan, double white_luminance);

}  // namespace osio
