// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/basis.h>

#include <span>
#include <string_view>
#include <vector>

namespace osio {

/// The bands of one set as functions of wavelength.
struct BandGrid {
    std::vector<double> wavelengths_nm;  ///< strictly increasing, not empty
    std::vector<double> edges_nm;        ///< bands + 1 increasing bin edges as the file states them, or none
    std::vector<NmSamples> responses;    ///< one a band, of any scale, or none

    [[nodiscard]] std::size_t size() const { return wavelengths_nm.size(); }

    /// Bin edges: as stated, else midpoints, the end bins symmetric about their centre. A single band
    /// without stated edges covers 360-830 nm.
    [[nodiscard]] std::vector<double> edges() const;

    /// True where every spacing is the mean spacing to 1e-3 of it: names are often rounded.
    [[nodiscard]] bool uniform() const;

    /// The mean spacing, nm; 0 for a single band.
    [[nodiscard]] double mean_step_nm() const;
};

/// The smallest number of bands that a basis can work with.
[[nodiscard]] std::size_t fewest_bands(Basis basis);

/// True where a basis takes bands for averages over bins rather than for samples.
[[nodiscard]] bool is_binned(Basis basis);

/// How integrals are taken with a basis: see quadrature_for; bins and responses are always integrated
/// on the 1 nm samples.
[[nodiscard]] Quadrature quadrature_for(Basis basis, std::span<const double> bands_nm);

/// Integral of a(lambda) b(lambda) phi_i(lambda) over 360-830 nm for each band of the grid, in the
/// units of a x b x nm. `basis` must not be Auto and must fit the grid (choose_basis sees to that).
///
/// Every basis reproduces constants with Extrapolation::Hold: the integrals then add up to
/// integral(a, b). Linear, Sprague, E2022 and Response reproduce straight lines between the end bands,
/// Sprague quartics away from its ends.
[[nodiscard]] std::vector<double> band_integrals(Basis basis, const BandGrid& grid, const NmSamples& a,
                                                 const NmSamples& b, Extrapolation extrapolation,
                                                 Quadrature quadrature);

}  // namespace osio
