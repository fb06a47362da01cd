// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/basis.h>

#include <span>
#include <vector>

namespace osio {

/// Weights for bands that are averages of the spectrum under responses of their own: the band's value is
/// sum(s_i f) / sum(s_i) at 1 nm. Of all spectra with these values the one of least curvature is taken,
/// which is a natural cubic spline's generalisation to averages (Wahba, Spline Models for Observational
/// Data, SIAM 1990, chapter 1): f = d0 + d1 x + sum c_i K s_i with sum c_i (s_i, 1) = sum c_i (s_i, x) = 0
/// and K(x, y) = |x - y|^3 / 12. Its integral is linear in the values; the coefficients are returned.
///
/// Narrow responses make it the natural spline through samples, boxes the spline with the boxes'
/// averages. Beyond the outermost centroids `extrapolation` decides. Two or more bands; empty where
/// the responses do not tell the bands apart.
[[nodiscard]] std::vector<double> response_integrals(std::span<const NmSamples> responses,
                                                     const NmSamples& weight, Extrapolation extrapolation);

/// A response of Gaussian shape with this full width at half maximum.
[[nodiscard]] NmSamples gaussian_response(double centre_nm, double fwhm_nm);

}  // namespace osio
