// SPDX-License-Identifier: Apache-2.0
//
// Laws of resampling, and its answers against the bases' integrals, which are other code.
#include <osio/collapse/resampling.h>
#include <osio/spectra/band_integrals.h>
#include <osio/spectra/bin_basis.h>

#include <support/bound.h>
#include <support/must.h>
#include <support/sets.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace osio::test {
namespace {

Resampling to(double first, double step, std::size_t count, Basis basis,
              Extrapolation extrapolation = Extrapolation::Hold) {
    return {{first, step, count}, basis, extrapolation};
}

std::vector<double> applied(const WeightMatrix& weights, const std::vector<double>& values) {
    std::vector<double> out;
    for (std::size_t row = 0; row < weights.rows(); ++row) {
        double sum = 0;
        for (std::size_t band = 0; band < weights.bands(); ++band)
            sum += weights.at(row, band) * values[band];
        out.push_back(sum);
    }
    return out;
}

std::vector<double> random_values(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0.1, 1);
    std::vector<double> out(count);
    for (double& value : out)
        value = uniform(random);
    return out;
}

constexpr Basis kAll[] = {Basis::Linear, Basis::Sprague, Basis::E2022, Basis::Bins, Basis::BinsCorrected};

TEST(Resampling, TheOwnGridIsTheIdentityBitForBit) {
    for (const Basis basis : kAll) {
        const SpectralSet set = set_of(Family::T, steps(400, 10, 700));
        const auto plan = must(plan_resampling(set, {}, to(400, 10, 31, basis)));
        EXPECT_TRUE(plan.identity);
        for (std::size_t row = 0; row < 31; ++row)
            for (std::size_t band = 0; band < 31; ++band)
                EXPECT_EQ(plan.weights.at(row, band), row == band ? 1.0 : 0.0) << basis_name(basis);
    }
}

/// The rows of samples at the old wavelengths are those bands alone, exactly.
TEST(Resampling, OldWavelengthsKeepTheirSamples) {
    for (const Basis basis : {Basis::Linear, Basis::Sprague, Basis::E2022}) {
        const SpectralSet set = set_of(Family::T, steps(400, 10, 700));
        const auto plan = must(plan_resampling(set, {}, to(400, 5, 61, basis)));
        for (std::size_t row = 0; row < 61; row += 2)
            for (std::size_t band = 0; band < 31; ++band)
                EXPECT_EQ(plan.weights.at(row, band), row == 2 * band ? 1.0 : 0.0);
    }
}

TEST(Resampling, ConstantsStayConstantWithHold) {
    Bound bound("resampled constant", 1e-12);
    for (const Basis basis : kAll) {
        const std::vector<double> nm = steps(450, 8, 650);
        const auto plan = must(plan_resampling(set_of(Family::T, nm), {}, to(380, 3.7, 100, basis)));
        for (const double value : applied(plan.weights, std::vector<double>(nm.size(), 1.0)))
            bound.see_relative(value, 1.0, std::string(basis_name(basis)));
    }
}

TEST(Resampling, BeyondTheBandsZeroIsZero) {
    const std::vector<double> nm = steps(500, 10, 600);
    for (const Basis basis : kAll) {
        const auto plan =
            must(plan_resampling(set_of(Family::T, nm), {}, to(400, 10, 31, basis, Extrapolation::Zero)));
        const auto out = applied(plan.weights, random_values(nm.size()));
        EXPECT_EQ(out[0], 0.0) << basis_name(basis);
        EXPECT_EQ(out[30], 0.0) << basis_name(basis);
        ASSERT_EQ(plan.warnings.size(), 1U);
        EXPECT_NE(plan.warnings[0].find("20 of 31 new bands lie beyond 500-600 nm: they are zero"),
                  std::string::npos)
            << plan.warnings[0];
    }
}

/// The value of the curve at a whole nanometre is its integral against a spike there.
TEST(Resampling, SamplesAreTheBasisItself) {
    Bound bound("sample against integral", 1e-12);
    const std::vector<double> nm = steps(400, 7, 687);
    for (const Basis basis : {Basis::Linear, Basis::Sprague, Basis::E2022}) {
        const auto plan = must(plan_resampling(set_of(Family::T, nm), {}, to(365, 1, 400, basis)));
        NmSamples ones{};
        ones.fill(1);
        for (std::size_t row = 0; row < 400; row += 3) {
            NmSamples spike{};
            spike[5 + row] = 1;
            const auto expected = band_integrals(basis, BandGrid{nm, {}, {}}, spike, ones,
                                                 Extrapolation::Hold, Quadrature::Sum1nm);
            for (std::size_t band = 0; band < nm.size(); ++band)
                bound.see_absolute(plan.weights.at(row, band), expected[band],
                                   std::string(basis_name(basis)));
        }
    }
}

/// Averages of bins against the mean of many values of the curve, by the definition of its lines.
TEST(Resampling, AveragesAreThoseOfTheCurve) {
    Bound bound("bin average against many samples", 2e-4);
    const std::vector<double> nm = steps(400, 10, 700);
    const std::vector<double> values = random_values(nm.size());
    const auto curve = [&](double at, bool corrected) {
        const double place = (at - 395) / 10;
        const auto i = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, 30.0));
        if (at < 395 || at > 705 || !corrected)
            return values[i];
        const double before = values[i > 0 ? i - 1 : 0], after = values[std::min<std::size_t>(i + 1, 30)];
        return values[i] + (after - before) / 20 * (at - nm[i]);
    };
    for (const bool corrected : {false, true}) {
        const auto plan = must(plan_resampling(
            set_of(Family::T, nm), {}, to(385, 6.5, 51, corrected ? Basis::BinsCorrected : Basis::Bins)));
        const auto out = applied(plan.weights, values);
        constexpr int kSamples = 20000;
        for (std::size_t row = 0; row < out.size(); ++row) {
            double sum = 0;
            for (int i = 0; i < kSamples; ++i)
                sum += curve(385 + 6.5 * (static_cast<double>(row) - 0.5 + (i + 0.5) / kSamples), corrected);
            bound.see_absolute(out[row], sum / kSamples, corrected ? "corrected" : "bins");
        }
    }
}

/// Bins that cover the same range hold the same integral, however it is cut.
TEST(Resampling, BinsKeepTheIntegral) {
    Bound bound("integral over the range", 1e-12);
    const std::vector<double> nm = steps(405, 10, 695);
    const std::vector<double> values = random_values(nm.size());
    double whole = 0;
    for (const double value : values)
        whole += 10 * value;
    for (const Basis basis : {Basis::Bins, Basis::BinsCorrected})
        for (const double step : {3.0, 20.0, 50.0}) {
            const auto count = static_cast<std::size_t>(300 / step);
            const auto plan =
                must(plan_resampling(set_of(Family::T, nm), {}, to(400 + step / 2, step, count, basis)));
            double sum = 0;
            for (const double value : applied(plan.weights, values))
                sum += step * value;
            bound.see_relative(sum, whole, std::string(basis_name(basis)));
        }
}

TEST(Resampling, WorksWhereNobodySees) {
    Bound bound("straight line in the infrared", 1e-12);
    const std::vector<double> nm = steps(1000, 25, 2500);
    const auto plan = must(plan_resampling(set_of(Family::T, nm), {}, to(1010, 10, 140, Basis::Auto)));
    EXPECT_EQ(plan.basis.basis, Basis::Sprague);
    const auto out = applied(plan.weights, nm);
    for (std::size_t i = 0; i < out.size(); ++i)
        bound.see_relative(out[i], 1010 + 10 * static_cast<double>(i), "line");
}

TEST(Resampling, BandsOfOneWavelengthCountAsTheirMean) {
    const SpectralSet set = set_of(Family::T, {400, 500, 500, 600});
    const auto plan = must(plan_resampling(set, {}, to(400, 100, 3, Basis::Linear)));
    EXPECT_FALSE(plan.identity);
    EXPECT_EQ(applied(plan.weights, {1, 2, 4, 8}), (std::vector<double>{1, 3, 8}));
}

TEST(Resampling, WhatCannotBeIsRefused) {
    const SpectralSet set = set_of(Family::T, steps(400, 10, 700));
    EXPECT_EQ(plan_resampling(set, {}, to(400, 10, 31, Basis::Response)).error().code,
              ErrorCode::InvalidGrid);
    EXPECT_EQ(plan_resampling(set, {}, to(1000, 10, 31, Basis::Auto)).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(
        plan_resampling(set_of(Family::T, {400, 410, 450, 460, 470, 480}), {}, to(400, 5, 3, Basis::Sprague))
            .error()
            .code,
        ErrorCode::InvalidGrid);
}

TEST(Resampling, GridsAreRead) {
    EXPECT_EQ(must(parse_wavelength_grid("400:10:700")).count, 31U);
    EXPECT_EQ(must(parse_wavelength_grid("400:7:410")).count, 2U);
    EXPECT_EQ(must(parse_wavelength_grid("400:0.1:401")).wavelengths_nm()[3], 400.3);
    EXPECT_EQ(must(parse_wavelength_grid("550:10:550")).wavelengths_nm(), std::vector<double>{550});
    for (const char* text : {"", "400", "400:10", "400:0:700", "400:-1:300", "700:10:400", "0:10:700",
                             "400:10:700:1", "a:b:c", "1:1e-9:2", "400:10:1e400"})
        EXPECT_EQ(parse_wavelength_grid(text).error().code, ErrorCode::Usage) << text;
}

}  // namespace
}  // namespace osio::test
