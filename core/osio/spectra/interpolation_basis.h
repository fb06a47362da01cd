// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/basis.h>

#include <span>
#include <vector>

/// Bases that join samples by polynomials of more than two of them, summed at 1 nm. Between the end
/// bands only; beyond them `extrapolation` decides.
namespace osio {

/// Sprague's quintics: two values, slopes and curvatures at each sample from six (CIE 167:2005, equation
/// 1); the two samples missing at each end are those of CIE 167:2005, equations 2 to 5. At least six
/// bands, equally spaced (each place is taken from the first, the last and the count).
[[nodiscard]] std::vector<double> sprague_integrals(std::span<const double> bands_nm, const NmSamples& weight,
                                                    Extrapolation extrapolation);

/// ASTM E2022: Lagrange's cubic through the four nearest samples, in the first and the last interval
/// the parabola through the three nearest. At least three bands, of any spacing.
[[nodiscard]] std::vector<double> e2022_integrals(std::span<const double> bands_nm, const NmSamples& weight,
                                                  Extrapolation extrapolation);

}  // namespace osio
