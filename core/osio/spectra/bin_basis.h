// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/basis.h>

#include <span>
#include <vector>

/// Bases of bin averages. The weight w = S x cbar is the piecewise-linear curve through its 1 nm samples,
/// integrated exactly over each bin; over the half nanometre beyond 360 and 830 nm it keeps its end
/// value, so that its integral over all is the sum at 1 nm to rounding.
namespace osio {

/// Constant in each bin: m0[i] = integral of w over [edges[i], edges[i + 1]]. With Hold, what lies beyond
/// the end bins belongs to them.
[[nodiscard]] std::vector<double> bin_integrals(std::span<const double> edges_nm, const NmSamples& weight,
                                                Extrapolation extrapolation);

/// In each bin the straight line with the slope (v[i + 1] - v[i - 1]) / 2h about the bin's average v[i]:
///
///     out[i] = m0[i] + (m1[i - 1] - m1[i + 1]) / 2h,  m1[i] = integral of (lambda - centre[i]) w over bin i.
///
/// For a smooth w of bin averages c this is h (c - d2c / 12). Before the first bin there is, with Hold,
/// another of the same value, with Zero one of zero; likewise after the last. Bins of equal width h.
[[nodiscard]] std::vector<double> corrected_bin_integrals(std::span<const double> edges_nm,
                                                          const NmSamples& weight,
                                                          Extrapolation extrapolation);

/// The share of each bin's value in the average over [low_nm, high_nm] of the curve that is constant in each
/// bin, or, `corrected`, the straight lines above. Beyond the end bins the curve keeps their values with
/// Hold (not their lines) and is zero with Zero. low_nm < high_nm.
[[nodiscard]] std::vector<double> bin_average_weights(std::span<const double> edges_nm, double low_nm,
                                                      double high_nm, bool corrected,
                                                      Extrapolation extrapolation);

}  // namespace osio
