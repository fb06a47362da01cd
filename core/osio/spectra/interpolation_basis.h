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

/// phi_i(nm) of each band for Linear, Sprague or E2022, at any wavelength: the curve's value there is their
/// sum times the bands' values. At a band's own wavelength exactly 1 for it and 0 for the others. The bands
/// must be those that the basis needs.
[[nodiscard]] std::vector<double> interpolation_weights(Basis basis, std::span<const double> bands_nm,
                                                        double nm, Extrapolation extrapolation);

}  // namespace osio
