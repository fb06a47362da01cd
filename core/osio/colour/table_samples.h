// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/spectra/basis.h>
#include <osio/spectra/spectrum.h>

#include <array>
#include <string>
#include <string_view>

/// What tables of lights, filters and sensitivities share on their way to 1 nm.
namespace osio {

/// Straight lines at 360, 361, ..., 830 nm, zero outside the curve.
[[nodiscard]] NmSamples sampled_at_1nm(const Spectrum& spectrum);

/// The same, but beyond its ends the curve keeps its end values.
[[nodiscard]] NmSamples sampled_at_1nm_held(const Spectrum& spectrum);

/// Values at 200, 201, ..., 359 nm: below what an observer sees, where light counts only for what it
/// excites.
using UltravioletSamples = std::array<double, 160>;
inline constexpr int kUltravioletFirstNm = kObserverFirstNm - 160;

/// Straight lines at 200, 201, ..., 359 nm, zero outside the curve.
[[nodiscard]] UltravioletSamples ultraviolet_at_1nm(const Spectrum& spectrum);

/// The same, but beyond its ends the curve keeps its end values.
[[nodiscard]] UltravioletSamples ultraviolet_at_1nm_held(const Spectrum& spectrum);

/// A name for the numbers: equal samples have equal digests.
[[nodiscard]] std::string digest_of(const NmSamples& samples);

/// Usage where the curve is zero or absent at every whole nanometre of 360-830 nm; `quantity` is what
/// it has none of ("power", "sensitivity").
[[nodiscard]] Result<void> check_not_black(const NmSamples& samples, const Spectrum& spectrum,
                                           std::string_view quantity, std::string_view path);

}  // namespace osio
