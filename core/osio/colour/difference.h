// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/colour/cie_lab.h>

#include <span>

namespace osio {

/// The CIEDE2000 colour difference (ISO/CIE 11664-6; Sharma, Wu, Dalal 2005) with kL = kC = kH = 1.
/// Symmetric, zero for equal colours. Hues 180 degrees apart to within 1e-9 count as exactly that far
/// apart, where the formula jumps: otherwise the last bit of an arc tangent would decide (the
/// published value of Sharma's pair 14 is 4.8045, a comparison without margin may give 4.7461).
[[nodiscard]] double delta_e_2000(const Lab& a, const Lab& b);

/// Of some pairs of colours.
struct DifferenceSummary {
    double mean = 0;
    double max = 0;
};

/// CIEDE2000 between pairs of XYZ, all seen under `white`. For equal counts above 0.
[[nodiscard]] DifferenceSummary differences_of(std::span<const Vector3> found,
                                               std::span<const Vector3> wanted, const Vector3& white);

}  // namespace osio
