// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/colour/table_samples.h>
#include <osio/spectra/basis.h>

namespace osio {

/// The correlated colour temperatures for which CIE daylight is defined (CIE 15:2018, 4.1.2).
inline constexpr double kDaylightFirstKelvin = 4000;
inline constexpr double kDaylightLastKelvin = 25000;

/// Relative power of CIE daylight at a correlated colour temperature, at 1 nm, 100 at 560 nm.
///
/// CIE 15:2018, 4.1.2: S0 + M1 S1 + M2 S2, M1 and M2 rounded to three decimals as the standard says
/// (unrounded they miss its tables by 0.016), straight lines between the 10 nm of S0, S1, S2. The
/// nominal D65 is daylight at 6500 x 1.4388 / 1.438 = 6503.6 K. Usage outside 4000-25000 K.
[[nodiscard]] Result<NmSamples> daylight_power(double correlated_kelvin);

/// Its ultraviolet from 300 nm on, where S0, S1 and S2 begin; zero below.
[[nodiscard]] Result<UltravioletSamples> daylight_ultraviolet(double correlated_kelvin);
inline constexpr double kDaylightFirstNm = 300;

}  // namespace osio
