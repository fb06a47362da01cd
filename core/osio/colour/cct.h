// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/colour/cie_lab.h>

namespace osio {

/// Correlated colour temperature, and the distance from the Planckian locus in CIE 1960 (u, v),
/// positive above the locus, towards green (CIE 15:2018, 9.4; the sign as in ANSI C78.377).
struct ColourTemperature {
    double cct_k = 0;
    double duv = 0;
};

/// Range of temperatures that are looked for. Below it the locus leaves what an eye sees as light;
/// above it one step in the sixth digit of u' is more than a thousand kelvins.
inline constexpr double kLowestCctK = 1000;
inline constexpr double kHighestCctK = 100000;

/// Distance beyond which a colour has no correlated temperature (CIE 15:2018, 9.4).
inline constexpr double kFarthestDuv = 0.05;

/// Of a chromaticity of the 2 degree observer: the temperature of the nearest point of the Planckian
/// locus in CIE 1960 (u, v), which is u' and 2/3 v'.
///
/// The locus is Planck's law with c2 = h c / k of SI 2019, summed at 1 nm over 360-830 nm against the
/// CIE 1931 observer. In reciprocal temperature it is smooth and nearly evenly curved, so the nearest
/// point is bracketed by equal steps of it and refined by golden sections: to 1e-6 of temperatures from
/// 1100 to 20000 K within Duv 0.02 (tested), where the rounding of squared distances sets the limit.
/// InvalidGrid where the nearest point is an end of the range, or farther than kFarthestDuv.
[[nodiscard]] Result<ColourTemperature> colour_temperature(const UniformChromaticity& colour);

/// The point of the locus at `temperature_k` > 0.
[[nodiscard]] UniformChromaticity planckian_chromaticity(double temperature_k);

}  // namespace osio
