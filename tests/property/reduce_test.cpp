// SPDX-License-Identifier: Apache-2.0
//
// Fewer bands with the colours of many: laws of the fit, of the search and of the projection, and an obvious twin of each
// step that pixels go through.
#include <osio/collapse/kernel.h>
#include <osio/colour/difference.h>
#include <osio/reduce/bin_fit.h>
#include <osio/reduce/bin_search.h>
#include <osio/reduce/colour_check.h>
#include <osio/reduce/non_negative.h>
#include <osio/reduce/scene_basis.h>

#include <support/random_numbers.h>
#include <support/sets.h>

#include <array>
#include <cmath>
#include <limits>

namespace osio {
namespace {

using test::plan_of;
using test::set_of;
using test::steps;
using test::uniform;

std::vector<Demand> demands_of(const SpectralSet& set, const std::vector<std::string>& lights) {
    std::vector<Demand> out;
    for (const std::string& light : lights)
        out.push_back(make_demand(plan_of(set, "to=xyz&illuminant=" + light).value(), 1));
    return out;
}

const std::vector<std::string> kLights{"D65", "A", "FL11", "LED-B3"};

/// Humps and slopes, 0 to 1.
std::vector<double> smooth_spectrum(std::span<const double> nm) {
    std::array<double, 9> c{};
    for (double& v : c)
        v = uniform(0, 1);
    std::vector<double> out;
    for (const double at : nm) {
        double v = 0.05 + 0.2 * c[0];
        for (std::size_t hump = 0; hump < 4; ++hump)
            v += 0.17 * std::exp(-std::pow((at - 400 - 300 * c[1 + hump]) / (30 + 60 * c[5 + hump]), 2));
        out.push_back(v);
    }
    return out;
}

SpectrumSample smooth_sample(std::span<const double> nm, std::size_t count) {
    SpectrumSample out(nm.size());
    for (std::size_t i = 0; i < count; ++i)
        out.add(smooth_spectrum(nm));
    return out;
}

std::vector<double> even_bins(double first, double last, std::size_t count) {
    std::vector<double> out;
    for (std::size_t i = 0; i <= count; ++i)
        out.push_back(first + (last - first) * static_cast<double>(i) / static_cast<double>(count));
    return out;
}

Vector3 sum(const WeightMatrix& weights, std::size_t first_row, std::span<const double> samples) {
    Vector3 out{};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < samples.size(); ++i)
            out[c] += weights.at(first_row + c, i) * samples[i];
    return out;
}

std::vector<double> times(const WeightMatrix& matrix, std::span<const double> spectrum) {
    std::vector<double> out(matrix.rows(), 0.0);
    for (std::size_t row = 0; row < matrix.rows(); ++row)
        for (std::size_t i = 0; i < spectrum.size(); ++i)
            out[row] += matrix.at(row, i) * spectrum[i];
    return out;
}

/// The largest CIEDE2000 of a spectrum over all demands, with edges fitted to it.
double difference(const std::vector<Demand>& demands, const BinFit& fit, std::span<const double> edges,
                  double fidelity, std::span<const double> spectrum) {
    const WeightMatrix weights = fit.weights(edges);
    const auto samples = times(fit.fit(edges, weights, fidelity, fit.bands()), spectrum);
    double out = 0;
    for (std::size_t d = 0; d < demands.size(); ++d)
        out = std::max(out, delta_e_2000(lab_of(sum(demands[d].plan.weights, 0, spectrum), demands[d].white),
                                         lab_of(sum(weights, 3 * d, samples), demands[d].white)));
    return out;
}

TEST(Reduce, AsManyBinsAsDemandsMeetThemAllForAnySpectrum) {
    const auto set = set_of(Family::T, steps(380, 5, 780));
    const auto demands = demands_of(set, kLights);
    const BinFit fit(demands);
    const auto edges = even_bins(380, 780, 20);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        std::vector<double> noise;
        for (std::size_t band = 0; band < set.bands.size(); ++band)
            noise.push_back(uniform(0, 1));
        worst = std::max(worst, difference(demands, fit, edges, 1e-3, noise));
    }
    std::printf("noise in 20 bins under four lights: largest CIEDE2000 %.2g / allowed 0.0001\n", worst);
    EXPECT_LE(worst, 1e-4);
}

TEST(Reduce, FewBinsKeepSmoothSpectraAndMoreKeepThemBetter) {
    const auto nm = steps(380, 5, 780);
    const auto set = set_of(Family::T, nm);
    const auto demands = demands_of(set, kLights);
    const BinFit fit(demands);
    const BinSearch search(demands, fit);
    const SpectrumSample sample = smooth_sample(nm, 400);
    double before = std::numeric_limits<double>::infinity();
    for (const std::size_t count : {4U, 7U, 12U}) {
        const auto edges = search.place(count, 0.02, sample);
        double worst = 0;
        for (std::size_t i = 0; i < sample.size(); ++i)
            worst = std::max(worst, difference(demands, fit, edges, 0.02, sample.pixel(i)));
        std::printf("smooth spectra in %zu bins: largest CIEDE2000 %.3g\n", count, worst);
        EXPECT_LT(worst, before);
        before = worst;
    }
    EXPECT_LE(before, 0.1);
}

TEST(Reduce, FlatSpectraStayFlat) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto demands = demands_of(set, kLights);
    const BinFit fit(demands);
    for (const double fidelity : {0.02, 1.0, 100.0})
        for (const std::size_t count : {1U, 2U, 5U, 11U}) {
            const auto edges = even_bins(400, 700, count);
            const auto matrix = fit.fit(edges, fit.weights(edges), fidelity, fit.bands());
            for (const double sample : times(matrix, std::vector<double>(set.bands.size(), 1.0)))
                EXPECT_NEAR(sample, 1, 1e-7);
        }
}

TEST(Reduce, FidelityAboveAllGivesTheAverages) {
    const auto nm = steps(400, 10, 700);
    const auto demands = demands_of(set_of(Family::T, nm), {"D65"});
    const BinFit fit(demands);
    const auto edges = even_bins(400, 700, 5);
    const auto samples = times(fit.fit(edges, fit.weights(edges), 1e6, fit.bands()), nm);
    for (std::size_t bin = 0; bin < samples.size(); ++bin)
        EXPECT_NEAR(samples[bin], (edges[bin] + edges[bin + 1]) / 2, 1e-6);
}

TEST(Reduce, ThePlanOfAReaderWeighsAsTheFitDoes) {
    const auto demands = demands_of(set_of(Family::T, steps(380, 5, 780)), kLights);
    const BinFit fit(demands);
    const std::vector<double> edges{380, 431, 480, 497, 560, 612, 650, 780};
    std::vector<double> centres;
    SpectralMetadata metadata;
    metadata.bin_edges_nm = edges;
    metadata.basis = "bins";
    for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin)
        centres.push_back((edges[bin] + edges[bin + 1]) / 2);
    const auto set = set_of(Family::T, centres);
    const WeightMatrix weights = fit.weights(edges);
    for (std::size_t d = 0; d < demands.size(); ++d) {
        const auto plan =
            make_plan(set, metadata, test::request_of("to=xyz&illuminant=" + kLights[d]), test::no_files)
                .value();
        EXPECT_EQ(plan.basis.basis, Basis::Bins);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t bin = 0; bin < centres.size(); ++bin)
                EXPECT_NEAR(plan.weights.at(c, bin), weights.at(3 * d + c, bin), 1e-13);
    }
}

TEST(Reduce, EdgesAreInOrderInRangeAndNoWorseThanEvenOnes) {
    const auto nm = steps(400, 5, 720);
    const auto demands = demands_of(set_of(Family::T, nm), {"D65", "FL11"});
    const BinFit fit(demands);
    const BinSearch search(demands, fit);
    const SpectrumSample sample = smooth_sample(nm, 300);
    const auto worst = [&](std::span<const double> edges) {
        double out = 0;
        for (std::size_t i = 0; i < sample.size(); ++i)
            out = std::max(out, difference(demands, fit, edges, 0.02, sample.pixel(i)));
        return out;
    };
    for (const std::size_t count : {1U, 2U, 3U, 6U, 64U}) {
        const auto edges = search.place(count, 0.02, sample);
        ASSERT_EQ(edges.size(), count + 1);
        EXPECT_EQ(edges.front(), 400);
        EXPECT_EQ(edges.back(), 720);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_GE(edges[i + 1] - edges[i], 1);
        if (count == 6) {
            EXPECT_LT(worst(edges), worst(even_bins(400, 720, count)));
        }
        EXPECT_EQ(edges, search.place(count, 0.02, sample));
    }
}

TEST(Reduce, PixelsWithoutAColourAreNotSampled) {
    SpectrumSample sample(2);
    sample.add(std::array{0.5, std::numeric_limits<double>::quiet_NaN()});
    sample.add(std::array{std::numeric_limits<double>::infinity(), 0.5});
    sample.add(std::array{0.25, 0.5});
    ASSERT_EQ(sample.size(), 1U);
    EXPECT_EQ(sample.pixel(0)[0], 0.25);
}

TEST(Reduce, EigenvectorsAreThose) {
    const std::size_t n = 12;
    WeightMatrix a(n, n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            a.at(i, j) = a.at(j, i) = uniform(-1, 1);
    const SymmetricEigen eigen = symmetric_eigen(a);
    for (std::size_t v = 0; v < n; ++v)
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < n; ++j)
                sum += a.at(i, j) * eigen.vectors.at(j, v);
            ASSERT_NEAR(sum, eigen.values[v] * eigen.vectors.at(i, v), 1e-12);
        }
}

TEST(Reduce, AsManyCurvesAsBandsAreTheIdentityAndFewerLoseLessTheMoreThereAre) {
    const auto nm = steps(400, 10, 700);
    const auto demands = demands_of(set_of(Family::T, nm), kLights);
    const BinFit fit(demands);
    const SpectrumSample sample = smooth_sample(nm, 500);
    const SceneFit scene(demands, fit, 1, sample);
    ASSERT_EQ(scene.columns().size(), nm.size());
    double before = std::numeric_limits<double>::infinity();
    for (const std::size_t count : {2U, 5U, 9U, 31U}) {
        const SceneBasis basis = scene.first(count);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j) {
                double sum = 0;
                for (std::size_t band = 0; band < nm.size(); ++band)
                    sum += basis.coefficients.at(i, band) * basis.expansion.at(band, j);
                ASSERT_NEAR(sum, i == j, 1e-9);
            }
        double worst = 0, away = 0;
        for (std::size_t i = 0; i < sample.size(); ++i) {
            const auto again = times(basis.expansion, times(basis.coefficients, sample.pixel(i)));
            for (std::size_t band = 0; band < nm.size(); ++band)
                away = std::max(away, std::abs(again[band] - sample.pixel(i)[band]));
            for (const Demand& demand : demands)
                worst = std::max(
                    worst, delta_e_2000(lab_of(sum(demand.plan.weights, 0, sample.pixel(i)), demand.white),
                                        lab_of(sum(demand.plan.weights, 0, again), demand.white)));
        }
        std::printf("%zu curves: largest CIEDE2000 %.3g\n", count, worst);
        EXPECT_LT(worst, before);
        before = worst;
        if (count == nm.size()) {
            EXPECT_LT(away, 1e-9);
        }
    }
}

/// A random metric of the kind that a fit has: few directions that matter much.
WeightMatrix random_metric(std::size_t n) {
    WeightMatrix out(n, n);
    for (std::size_t row = 0; row < 4; ++row) {
        std::vector<double> g(n);
        for (double& v : g)
            v = uniform(-1, 1) * std::pow(10, uniform(-2, 1));
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                out.at(i, j) += g[i] * g[j];
    }
    for (std::size_t i = 0; i < n; ++i)
        out.at(i, i) += 0.01;
    return out;
}

double distance(const WeightMatrix& metric, std::span<const double> a, std::span<const double> b) {
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < a.size(); ++j)
            out += (a[i] - b[i]) * metric.at(i, j) * (a[j] - b[j]);
    return out;
}

/// The twin: projected coordinate descent, slow and obvious.
std::vector<double> nearest_by_descent(const WeightMatrix& metric, std::span<const double> from) {
    std::vector<double> x(from.begin(), from.end());
    for (double& v : x)
        v = std::max(v, 0.0);
    for (int sweep = 0; sweep < 200000; ++sweep) {
        double moved = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            double slope = 0;
            for (std::size_t j = 0; j < x.size(); ++j)
                slope += metric.at(i, j) * (x[j] - from[j]);
            const double to = std::max(0.0, x[i] - slope / metric.at(i, i));
            moved = std::max(moved, std::abs(to - x[i]));
            x[i] = to;
        }
        if (moved < 1e-14)
            break;
    }
    return x;
}

TEST(Reduce, TheNearestNonNegativeIsNearest) {
    for (int round = 0; round < 300; ++round) {
        const std::size_t n = 2 + static_cast<std::size_t>(round) % 9;
        const WeightMatrix metric = random_metric(n);
        std::vector<double> from(n);
        for (double& v : from)
            v = uniform(-0.5, 1);
        std::vector<double> x = from;
        NonNegative(metric).project(x);
        for (const double v : x)
            ASSERT_GE(v, 0);
        const auto twin = nearest_by_descent(metric, from);
        ASSERT_LE(distance(metric, x, from), distance(metric, twin, from) * (1 + 1e-9) + 1e-12);
    }
}

TEST(Reduce, WhatIsNotNegativeStaysToTheBit) {
    const WeightMatrix metric = random_metric(5);
    std::vector<double> x{0.1, 0, 0.3, 7, 1e-9};
    const auto before = x;
    NonNegative(metric).project(x);
    EXPECT_EQ(x, before);
    std::vector<double> undefined{std::numeric_limits<double>::quiet_NaN(), -1, 0, 0, 0};
    NonNegative(metric).project(undefined);
    EXPECT_TRUE(std::isnan(undefined[0]));
    EXPECT_EQ(undefined[1], -1);
}

TEST(Reduce, DifferencesAreThoseOfTheObviousLoop) {
    constexpr std::size_t kCount = 1000;
    const Vector3 white{0.95, 1, 1.09};
    std::array<std::vector<float>, 3> a, b;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < kCount; ++i) {
            a[c].push_back(static_cast<float>(uniform(0, 1)));
            b[c].push_back(i % 10 == 0 ? a[c][i] : a[c][i] * static_cast<float>(uniform(0.9, 1.1)));
        }
    a[1][5] = std::numeric_limits<float>::quiet_NaN();
    b[2][6] = std::numeric_limits<float>::infinity();
    const std::array<const float*, 3> first{a[0].data(), a[1].data(), a[2].data()};
    const std::array<const float*, 3> second{b[0].data(), b[1].data(), b[2].data()};
    std::vector<double> found(kCount);
    colour_differences(first, second, white, kCount, found);
    for (std::size_t i = 0; i < kCount; ++i) {
        const auto colour = [i](const std::array<std::vector<float>, 3>& planes) {
            return Vector3{static_cast<double>(planes[0][i]), static_cast<double>(planes[1][i]),
                           static_cast<double>(planes[2][i])};
        };
        if (i == 5) {
            EXPECT_TRUE(std::isnan(found[i]));
        } else if (i == 6) {
            EXPECT_TRUE(std::isinf(found[i]));
        } else {
            EXPECT_EQ(found[i],
                      i % 10 == 0 ? 0 : delta_e_2000(lab_of(colour(a), white), lab_of(colour(b), white)));
        }
    }
}

}  // namespace
}  // namespace osio
