// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/spectra/spectrum.h>

#include <span>

/// Arithmetic on spectra, sample by sample (Pharr, Jakob, Humphreys, Physically Based Rendering, ch. 5).
///
/// Operations on two spectra need equal wavelengths, and InvalidGrid says where they differ: a step at
/// the end of one spectrum has no place on the other's grid, so nothing is resampled in silence
/// (resampled() does it aloud). Values follow IEEE arithmetic: the root of a negative sample is NaN,
/// which has_nan() finds.
namespace osio {

/// What a spectrum is beyond its first and last sample.
enum class EdgeRule {
    Hold,  ///< the value of the end sample
    Zero,
};

[[nodiscard]] Result<Spectrum> sum(const Spectrum& a, const Spectrum& b);
[[nodiscard]] Result<Spectrum> difference(const Spectrum& a, const Spectrum& b);
[[nodiscard]] Result<Spectrum> product(const Spectrum& a, const Spectrum& b);
[[nodiscard]] Result<Spectrum> quotient(const Spectrum& a, const Spectrum& b);

/// (1 - t) a + t b; a at t = 0 and b at t = 1, exactly.
[[nodiscard]] Result<Spectrum> lerp(double t, const Spectrum& a, const Spectrum& b);

[[nodiscard]] Spectrum scaled(const Spectrum& a, double factor);
[[nodiscard]] Spectrum square_root(const Spectrum& a);
[[nodiscard]] Spectrum power(const Spectrum& a, double exponent);
[[nodiscard]] Spectrum exponential(const Spectrum& a);

/// Every sample within low to high; NaN stays NaN. `low` must not exceed `high`.
[[nodiscard]] Spectrum clamped(const Spectrum& a, double low, double high);

/// True where every sample is zero; true for no samples.
[[nodiscard]] bool is_black(const Spectrum& a);
[[nodiscard]] bool has_nan(const Spectrum& a);

/// The straight lines of `a` at other wavelengths, strictly increasing nm.
[[nodiscard]] Spectrum resampled(const Spectrum& a, std::span<const double> wavelengths_nm, EdgeRule edge);

/// Mean over [low_nm, high_nm] of the straight lines through samples in any order; the value there where
/// low = high. Samples of equal wavelength count as their mean. With EdgeRule::Zero the mean is taken over
/// the whole of [low, high] all the same, and a single sample, which has no width, contributes nothing.
/// Usage: no samples, counts that differ, a wavelength that is not finite, or low > high.
[[nodiscard]] Result<double> average(std::span<const double> wavelengths_nm, std::span<const double> values,
                                     double low_nm, double high_nm, EdgeRule edge);

}  // namespace osio
