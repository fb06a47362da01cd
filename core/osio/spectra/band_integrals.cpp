// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/band_integrals.h>
#include <osio/spectra/bin_basis.h>
#include <osio/spectra/interpolation_basis.h>
#include <osio/spectra/response_basis.h>

#include <cmath>

namespace osio {

namespace {

constexpr double kUniformTolerance = 1e-3;

NmSamples product(const NmSamples& a, const NmSamples& b) {
    NmSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = a[i] * b[i];
    return out;
}

}  // namespace

std::vector<double> BandGrid::edges() const {
    if (!edges_nm.empty())
        return edges_nm;
    const auto& nm = wavelengths_nm;
    if (nm.size() == 1)
        return {kObserverFirstNm, kObserverLastNm};
    std::vector<double> out{nm[0] - (nm[1] - nm[0]) / 2};
    for (std::size_t i = 1; i < nm.size(); ++i)
        out.push_back((nm[i - 1] + nm[i]) / 2);
    out.push_back(nm.back() + (nm.back() - nm[nm.size() - 2]) / 2);
    return out;
}

bool BandGrid::uniform() const {
    const double step = mean_step_nm();
    for (std::size_t i = 1; i < size(); ++i)
        if (std::abs(wavelengths_nm[i] - wavelengths_nm[i - 1] - step) > kUniformTolerance * step)
            return false;
    return true;
}

double BandGrid::mean_step_nm() const {
    return size() < 2 ? 0
                      : (wavelengths_nm.back() - wavelengths_nm.front()) / static_cast<double>(size() - 1);
}

std::size_t fewest_bands(Basis basis) {
    switch (basis) {
    case Basis::Sprague: return 6;
    case Basis::E2022: return 3;
    case Basis::BinsCorrected: return 3;
    case Basis::Response: return 2;
    case Basis::Auto:
    case Basis::Linear:
    case Basis::Bins: break;
    }
    return 1;
}

bool is_binned(Basis basis) {
    return basis == Basis::Bins || basis == Basis::BinsCorrected || basis == Basis::Response;
}

Quadrature quadrature_for(Basis basis, std::span<const double> bands_nm) {
    return is_binned(basis) ? Quadrature::Sum1nm : quadrature_for(bands_nm);
}

std::vector<double> band_integrals(Basis basis, const BandGrid& grid, const NmSamples& a, const NmSamples& b,
                                   Extrapolation extrapolation, Quadrature quadrature) {
    switch (basis) {
    case Basis::Sprague: return sprague_integrals(grid.wavelengths_nm, product(a, b), extrapolation);
    case Basis::E2022: return e2022_integrals(grid.wavelengths_nm, product(a, b), extrapolation);
    case Basis::Bins: return bin_integrals(grid.edges(), product(a, b), extrapolation);
    case Basis::BinsCorrected: return corrected_bin_integrals(grid.edges(), product(a, b), extrapolation);
    case Basis::Response: return response_integrals(grid.responses, product(a, b), extrapolation);
    case Basis::Auto:
    case Basis::Linear: break;
    }
    return linear_basis_integrals(grid.wavelengths_nm, a, b, extrapolation, quadrature);
}

}  // namespace osio
