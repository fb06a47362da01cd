// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/wavelength.h>

#include <array>
#include <span>
#include <vector>

/// How band samples become a function of wavelength, and what its integrals are.
///
/// A basis gives each band i a function phi_i, so that the spectrum of a pixel is
/// sum_i value_i phi_i(lambda). Every integral of that spectrum is then a weighted sum of the band
/// values, with weights that do not depend on the pixel.
namespace osio {

/// Values at 360, 361, ..., 830 nm.
using NmSamples = std::array<double, kObserverSampleCount>;

/// Which phi_i.
enum class Basis {
    Auto,           ///< what the file says and the bands suggest: see choose_basis
    Linear,         ///< samples joined by straight lines
    Sprague,        ///< samples joined by Sprague's quintics (CIE 167:2005)
    E2022,          ///< samples joined by cubics, parabolas at the ends (ASTM E2022)
    Bins,           ///< averages over bins, constant in each
    BinsCorrected,  ///< averages over equal bins, with the slope that the neighbours tell
    Response,       ///< averages weighted by each band's own response, the smoothest curve through them
};

/// What the spectrum is beyond the first and the last band.
enum class Extrapolation {
    Hold,  ///< the value of the end band
    Zero,  ///< zero
};

/// How integrals over 360-830 nm are taken.
enum class Quadrature {
    Sum1nm,  ///< the sum at 1 nm of CIE 15:2018, 7.1
    Exact,   ///< the integral of the product of the piecewise-linear curves, to rounding
};

/// Exact where two neighbouring bands inside 360-830 nm are less than 1 nm apart, because a sum at
/// 1 nm would step over them; the CIE's sum elsewhere. `bands_nm` strictly increasing.
[[nodiscard]] Quadrature quadrature_for(std::span<const double> bands_nm);

/// Integral of a(lambda) b(lambda) over 360-830 nm.
[[nodiscard]] double integral(const NmSamples& a, const NmSamples& b, Quadrature quadrature);

/// Integral of a(lambda) b(lambda) phi_i(lambda) over 360-830 nm for each band of the linear basis;
/// one number for each band. `bands_nm` must be strictly increasing and not empty. The other bases are
/// in band_integrals.h.
[[nodiscard]] std::vector<double> linear_basis_integrals(std::span<const double> bands_nm, const NmSamples& a,
                                                         const NmSamples& b, Extrapolation extrapolation,
                                                         Quadrature quadrature);

}  // namespace osio
