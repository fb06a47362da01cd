// SPDX-License-Identifier: Apache-2.0
//
// Laws of the bases: what each reproduces, and how they answer each other.
#include <osio/spectra/band_integrals.h>
#include <osio/spectra/response_basis.h>

#include <support/bound.h>
#include <support/sets.h>

#include <cmath>
#include <numeric>
#include <random>

namespace osio::test {
namespace {

NmSamples ones() {
    NmSamples out{};
    out.fill(1);
    return out;
}

/// A weight with a spike, as a fluorescent lamp times an observer has.
NmSamples spiky() {
    NmSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double nm = 360 + static_cast<double>(i);
        out[i] = std::exp(-std::pow((nm - 555) / 45, 2)) + (i == 186 ? 3 : 0);
    }
    return out;
}

BandGrid grid_of(const std::vector<double>& nm, double fwhm_nm = 0) {
    BandGrid grid{nm, {}, {}};
    if (fwhm_nm > 0)
        for (const double centre : nm)
            grid.responses.push_back(gaussian_response(centre, fwhm_nm));
    return grid;
}

double applied(const std::vector<double>& weights, const std::vector<double>& values) {
    return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
}

constexpr Basis kAll[] = {Basis::Linear, Basis::Sprague,       Basis::E2022,
                          Basis::Bins,   Basis::BinsCorrected, Basis::Response};

TEST(Basis, ConstantsAreReproducedByEveryOne) {
    Bound bound("integral of a constant", 1e-12);
    for (const Basis basis : kAll)
        for (const auto& nm :
             {steps(400, 10, 700), steps(380, 5, 780), steps(350, 20, 850), steps(500, 7, 560)}) {
            const auto w = band_integrals(basis, grid_of(nm, 8), ones(), spiky(), Extrapolation::Hold,
                                          Quadrature::Sum1nm);
            const double all = integral(ones(), spiky(), Quadrature::Sum1nm);
            bound.see_relative(applied(w, std::vector<double>(nm.size(), 1.0)), all,
                               std::string(basis_name(basis)));
        }
}

/// Inside the end bands a straight line's samples are its averages over equal bins too.
TEST(Basis, StraightLinesAreReproducedBetweenTheEndBands) {
    Bound bound("integral of a straight line", 1e-10);
    const auto nm = steps(350, 10, 840);
    std::vector<double> values;
    for (const double l : nm)
        values.push_back(0.2 + 0.003 * (l - 360));
    double expected = 0;
    const NmSamples weight = spiky();
    for (std::size_t i = 0; i < weight.size(); ++i)
        expected += weight[i] * (0.2 + 0.003 * static_cast<double>(i));
    for (const Basis basis : {Basis::Linear, Basis::Sprague, Basis::E2022}) {
        const auto w =
            band_integrals(basis, grid_of(nm), ones(), weight, Extrapolation::Hold, Quadrature::Sum1nm);
        bound.see_relative(applied(w, values), expected, std::string(basis_name(basis)));
    }
}

TEST(Basis, SpragueReproducesQuarticsAndE2022Cubics) {
    const auto nm = steps(340, 10, 850);
    const NmSamples weight = spiky();
    for (const auto& [basis, degree] : {std::pair(Basis::Sprague, 4), std::pair(Basis::E2022, 3)}) {
        Bound bound("integral of a polynomial of degree " + std::to_string(degree), 1e-11);
        const auto polynomial = [degree = degree](double l) {
            return 1 + std::pow((l - 600) / 100, degree) - 0.5 * (l - 600) / 100;
        };
        std::vector<double> values;
        for (const double l : nm)
            values.push_back(polynomial(l));
        double expected = 0;
        for (std::size_t i = 0; i < weight.size(); ++i)
            expected += weight[i] * polynomial(360 + static_cast<double>(i));
        const auto w =
            band_integrals(basis, grid_of(nm), ones(), weight, Extrapolation::Hold, Quadrature::Sum1nm);
        bound.see_relative(applied(w, values), expected, std::string(basis_name(basis)));
    }
}

/// Parabolas through bin averages: f = x^2 has the average x^2 + h^2 / 12 in a bin, and the slope that
/// the neighbours' averages tell is exact; what the correction misses is the curvature inside a bin.
TEST(Basis, CorrectedBinsAreCloserThanBinsForWhatIsSmooth) {
    const auto nm = steps(365, 10, 825);
    const NmSamples weight = spiky();
    std::vector<double> averages;
    for (const double centre : nm) {
        double sum = 0;
        for (int k = 0; k < 1000; ++k)
            sum += std::sin((centre - 5 + (k + 0.5) / 100) / 30);
        averages.push_back(1.5 + sum / 1000);
    }
    double truth = 0;
    for (std::size_t i = 0; i < weight.size(); ++i)
        truth += weight[i] * (1.5 + std::sin((360 + static_cast<double>(i)) / 30));
    const auto error = [&](Basis basis) {
        const auto w =
            band_integrals(basis, grid_of(nm), ones(), weight, Extrapolation::Hold, Quadrature::Sum1nm);
        return std::abs(applied(w, averages) / truth - 1);
    };
    EXPECT_LT(error(Basis::BinsCorrected), error(Basis::Bins) / 3);
}

/// The definition, written down a second time: moments by a fine midpoint rule.
TEST(Basis, CorrectedBinsFollowTheirFormula) {
    const auto nm = steps(400, 10, 700);
    const double h = 10;
    const NmSamples weight = spiky();
    const auto at = [&](double l) {
        const auto i = static_cast<std::size_t>(l - 360);
        return weight[i] + (l - 360 - static_cast<double>(i)) * (weight[i + 1] - weight[i]);
    };
    std::vector<double> m0, m1;
    for (const double centre : nm) {
        double a = 0, b = 0;
        constexpr int kSteps = 100000;
        for (int k = 0; k < kSteps; ++k) {
            const double l = centre - h / 2 + h * (k + 0.5) / kSteps;
            a += at(l) * h / kSteps;
            b += (l - centre) * at(l) * h / kSteps;
        }
        m0.push_back(a);
        m1.push_back(b);
    }
    const auto w = band_integrals(Basis::BinsCorrected, grid_of(nm), ones(), weight, Extrapolation::Zero,
                                  Quadrature::Sum1nm);
    Bound bound("corrected bins against their formula", 1e-7);
    for (std::size_t i = 0; i < nm.size(); ++i) {
        const double before = i > 0 ? m1[i - 1] : 0, after = i + 1 < nm.size() ? m1[i + 1] : 0;
        bound.see_absolute(w[i], m0[i] + (before - after) / (2 * h), std::to_string(nm[i]));
    }
}

TEST(Basis, SplittingABinInEqualHalvesChangesNothing) {
    Bound bound("bins split in halves", 1e-12);
    const NmSamples weight = spiky();
    const BandGrid coarse{{410, 430, 450}, {400, 420, 440, 460}, {}};
    const BandGrid fine{{405, 415, 425, 435, 445, 455}, {400, 410, 420, 430, 440, 450, 460}, {}};
    for (const auto extrapolation : {Extrapolation::Hold, Extrapolation::Zero}) {
        const auto a = band_integrals(Basis::Bins, coarse, ones(), weight, extrapolation, Quadrature::Sum1nm);
        const auto b = band_integrals(Basis::Bins, fine, ones(), weight, extrapolation, Quadrature::Sum1nm);
        for (std::size_t i = 0; i < a.size(); ++i)
            bound.see_relative(b[2 * i] + b[2 * i + 1], a[i], std::to_string(i));
    }
}

/// The curve of least curvature through averages of a smooth spectrum comes back to it.
TEST(Basis, ResponsesGiveBackWhatTheyAveraged) {
    const auto smooth = [](double l) { return 1 + 0.5 * std::sin(l / 50); };
    const NmSamples weight = spiky();
    double truth = 0;
    for (std::size_t i = 0; i < weight.size(); ++i)
        truth += weight[i] * smooth(360 + static_cast<double>(i));
    for (const double fwhm : {2.0, 10.0, 25.0}) {
        const BandGrid grid = grid_of(steps(370, 10, 820), fwhm);
        std::vector<double> averages;
        for (const NmSamples& response : grid.responses) {
            double sum = 0, all = 0;
            for (std::size_t i = 0; i < response.size(); ++i) {
                sum += response[i] * smooth(360 + static_cast<double>(i));
                all += response[i];
            }
            averages.push_back(sum / all);
        }
        const auto w =
            band_integrals(Basis::Response, grid, ones(), weight, Extrapolation::Hold, Quadrature::Sum1nm);
        EXPECT_NEAR(applied(w, averages) / truth, 1, 1e-5) << fwhm;
    }
}

SpectralMetadata stating(const std::string& basis) {
    SpectralMetadata metadata;
    metadata.basis = basis;
    return metadata;
}

TEST(BasisChoice, TheFileTheQuantityAndTheStepsDecide) {
    const auto chosen = [](Family family, const std::vector<double>& nm, const SpectralMetadata& metadata) {
        const auto set = set_of(family, nm);
        const auto choice =
            choose_basis(Basis::Auto, set, distinct_bands(set, metadata).grid, metadata).value();
        return std::string(basis_name(choice.basis)) + (choice.warning ? "!" : "");
    };
    const auto nm = steps(400, 10, 700);
    EXPECT_EQ(chosen(Family::T, nm, {}), "sprague");
    EXPECT_EQ(chosen(Family::T, {400, 500, 600, 700}, {}), "e2022");
    EXPECT_EQ(chosen(Family::T, {400, 500}, {}), "linear");
    EXPECT_EQ(chosen(Family::T, {400, 410, 430, 500, 600, 620, 700}, {}), "linear");
    EXPECT_EQ(chosen(Family::T, steps(400, 0.5, 700), {}), "linear");
    EXPECT_EQ(chosen(Family::S0, nm, {}), "bins-corrected");
    EXPECT_EQ(chosen(Family::S0, steps(400, 40, 680), {}), "bins-corrected");
    EXPECT_EQ(chosen(Family::S0, steps(400, 50, 700), {}), "bins");
    EXPECT_EQ(chosen(Family::S0, {400, 410, 430}, {}), "bins");
    EXPECT_EQ(chosen(Family::S0, nm, stating("linear")), "linear");
    EXPECT_EQ(chosen(Family::S0, nm, stating("wavelets")), "bins-corrected!");
    EXPECT_EQ(chosen(Family::S0, nm, stating("response")), "bins-corrected!");
    SpectralMetadata widths;
    widths.fwhm = Spectrum{{500}, {12}};
    EXPECT_EQ(chosen(Family::S0, nm, widths), "response");
    SpectralMetadata edges;
    edges.bin_edges_nm = {390, 420, 500};
    EXPECT_EQ(chosen(Family::S0, {400, 450}, edges), "bins");
}

TEST(BasisChoice, WhatCannotBeMeantIsRefusedAndWhatIsShortFallsBackAloud) {
    const auto refusal = [](const std::vector<double>& nm, const std::string& basis) {
        const auto plan = plan_of(set_of(Family::T, nm), "to=xyz&illuminant=D65&basis=" + basis);
        return plan ? plan->warnings.at(0) : plan.error().text();
    };
    const std::vector<double> uneven{400, 410, 430, 500, 600, 650, 700};
    EXPECT_EQ(refusal(uneven, "sprague"),
              "basis=sprague needs bands at equal steps, and these are not; use basis=linear");
    EXPECT_EQ(refusal(uneven, "bins-corrected"),
              "basis=bins-corrected needs bands at equal steps, and these are not; use basis=bins");
    EXPECT_EQ(refusal(uneven, "response").substr(0, 50),
              "basis=response needs a sensitivity of every band (");
    EXPECT_EQ(refusal({400, 500}, "e2022"),
              "basis=e2022 needs 3 bands and there are 2: straight lines are used");
    EXPECT_EQ(refusal(steps(400, 0.5, 500), "sprague").substr(0, 35), "basis=sprague is a sum at 1 nm and ");
}

}  // namespace
}  // namespace osio::test
