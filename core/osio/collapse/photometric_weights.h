// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>

namespace osio {

/// Weights of a radiance's photometry, one column for each of the plan's bands. For bands in
/// W/(sr m2 nm) the rows give luminance in cd/m2 (683 lm/W, V), scotopic luminance in scotopic cd/m2
/// (1700 lm/W, V') and radiance in W/(sr m2), all over 360-830 nm, with the plan's basis, extrapolation,
/// quadrature and exposure. Bands that share a wavelength count as their mean.
[[nodiscard]] WeightMatrix photometric_weights(const CollapsePlan& plan);

}  // namespace osio
