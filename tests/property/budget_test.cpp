// SPDX-License-Identifier: Apache-2.0
//
// A bound that is exceeded anywhere in a random search fails. Truth is summed in long double, 64 bits of
// fraction here, from the samples before they were stored.
#include <osio/base/half.h>
#include <osio/budget/error_budget.h>
#include <osio/budget/lab_bound.h>
#include <osio/budget/magnitude.h>
#include <osio/budget/output_colour.h>
#include <osio/collapse/kernel.h>
#include <osio/collapse/pixel_stage.h>
#include <osio/colour/difference.h>

#include <support/random_numbers.h>
#include <support/sets.h>

#include <array>
#include <cmath>

namespace osio {
namespace {

using test::plan_of;
using test::set_of;
using test::steps;
using test::uniform;

/// Of either sign now and then, of every magnitude from 2^-30 to 2^14.
double any_sample() {
    const double magnitude = std::exp2(uniform(-30, 14));
    return uniform(0, 1) < 0.1 ? -magnitude : uniform(0, 1) < 0.05 ? 0 : magnitude;
}

BandView view(const float& sample) {
    return {reinterpret_cast<const std::byte*>(&sample), SampleType::Float, 4};
}

BandView view(const std::uint16_t& half) {
    return {reinterpret_cast<const std::byte*>(&half), SampleType::Half, 2};
}

/// A half made by rounding to nearest, ties to even: what a writer stores.
std::uint16_t rounded_to_half(double value) {
    std::uint16_t best = 0;
    double distance = 1e300;
    // Bisection over the positive halves, which are ordered like their bits.
    std::uint16_t low = 0, high = 0x7BFF;
    const double magnitude = std::abs(value);
    while (low < high) {
        const auto middle = static_cast<std::uint16_t>((low + high + 1) / 2);
        if (static_cast<double>(float_from_half(middle)) <= magnitude)
            low = middle;
        else
            high = static_cast<std::uint16_t>(middle - 1);
    }
    for (const int step : {0, 1}) {
        const auto bits = static_cast<std::uint16_t>(low + step);
        const double d = std::abs(static_cast<double>(float_from_half(bits)) - magnitude);
        if (d < distance || (d == distance && bits % 2 == 0)) {
            best = bits;
            distance = d;
        }
    }
    return static_cast<std::uint16_t>(best | (value < 0 ? 0x8000 : 0));
}

/// One pixel's budget, its stored outputs' truth, and what was stored.
struct Trial {
    BudgetResult budget;
    std::array<float, 3> sums{};
};

template <class Sample>
Trial look_at(const CollapsePlan& plan, const std::vector<Sample>& samples, StoredDepth depth,
              const CollapsePlan* reference = nullptr) {
    std::vector<BandView> bands;
    for (const Sample& sample : samples)
        bands.push_back(view(sample));
    Trial trial;
    std::array<float*, 3> out{&trial.sums[0], &trial.sums[1], &trial.sums[2]};
    const std::span<float* const> rows(out.data(), plan.weights.rows());
    collapse_run(bands, plan.weights, 1, rows);
    const auto type = sizeof(Sample) == 2 ? SampleType::Half : SampleType::Float;
    auto budget = ErrorBudget::create(
        {plan, std::vector<SampleType>(samples.size(), type), depth, false, reference, {}, 1, {}});
    EXPECT_TRUE(budget);
    const auto worker = (*budget)->start_worker();
    const std::vector<const float*> sums(rows.begin(), rows.end());
    worker->look(bands, 1, sums);
    worker->deliver();
    trial.budget = (*budget)->result();
    return trial;
}

Vector3 exact_sums(const CollapsePlan& plan, const std::vector<double>& samples) {
    Vector3 out{};
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        long double sum = 0;
        for (std::size_t band = 0; band < samples.size(); ++band)
            sum += static_cast<long double>(plan.weights.at(row, band)) * samples[band];
        out[row] = static_cast<double>(sum);
    }
    return out;
}

/// The true difference does not exceed the bound, in X, Y, Z and in CIEDE2000.
void expect_within(const CollapsePlan& plan, const Vector3& found, const Vector3& truth,
                   const ErrorBound& bound) {
    const OutputColour colour = output_colour(plan, 1).value();
    const Vector3 a = colour.share_from_output * found, b = colour.share_from_output * truth;
    for (std::size_t c = 0; c < 3; ++c)  // a few roundings of this comparison itself
        ASSERT_LE(std::abs(a[c] - b[c]), bound.xyz[c] * (1 + 1e-12) + 1e-15 * std::abs(a[c]));
    const double delta = delta_e_2000(lab_of(a, {1, 1, 1}), lab_of(b, {1, 1, 1}));
    ASSERT_LE(delta, bound.delta_e_2000 + 1e-9);
}

Vector3 doubles(const std::array<float, 3>& sums) {
    return {static_cast<double>(sums[0]), static_cast<double>(sums[1]), static_cast<double>(sums[2])};
}

constexpr int kTrials = 4000;

std::vector<CollapsePlan> plans() {
    std::vector<CollapsePlan> out;
    for (const char* request :
         {"to=xyz&illuminant=FL11", "to=lin_rec709&illuminant=A", "to=acescg&illuminant=D65",
          "to=luminance&illuminant=D65", "to=srgb&illuminant=D50"})
        out.push_back(plan_of(set_of(Family::T, steps(400, 10, 700)), request).value());
    out.push_back(plan_of(set_of(Family::S0, steps(380, 5, 780)), "to=lin_rec2020").value());
    out.push_back(plan_of(set_of(Family::S0, steps(300, 1, 1000)), "to=xyz_d65").value());
    return out;
}

TEST(BudgetProperty, ArithmeticBoundsWhatFloatSumsLose) {
    for (const CollapsePlan& plan : plans())
        for (int i = 0; i < kTrials / 4; ++i) {
            std::vector<float> samples(plan.bands.size());
            std::vector<double> exact;
            const bool smooth = i % 2 == 0;
            for (float& sample : samples) {
                sample = static_cast<float>(smooth ? uniform(0, 1) : any_sample());
                exact.push_back(static_cast<double>(sample));
            }
            const Trial trial = look_at(plan, samples, StoredDepth::Float);
            expect_within(plan, doubles(trial.sums), exact_sums(plan, exact),
                          trial.budget.term(ErrorSource::Arithmetic));
        }
}

TEST(BudgetProperty, InputStorageBoundsWhatHalvesLost) {
    for (const CollapsePlan& plan : plans())
        for (int i = 0; i < kTrials / 4; ++i) {
            std::vector<std::uint16_t> halves;
            std::vector<double> before;
            for (std::size_t band = 0; band < plan.bands.size(); ++band) {
                before.push_back(i % 2 == 0 ? uniform(0, 1) : any_sample());
                halves.push_back(rounded_to_half(before.back()));
            }
            const Trial trial = look_at(plan, halves, StoredDepth::Float);
            ErrorBound both = trial.budget.term(ErrorSource::InputStorage);
            ASSERT_GT(both.delta_e_2000, 0);
            expect_within(plan, doubles(trial.sums), exact_sums(plan, before), trial.budget.total);
        }
}

TEST(BudgetProperty, OutputStorageBoundsRoundingAndClamping) {
    for (const CollapsePlan& plan : plans()) {
        if (plan.space.transfer != Transfer::Linear)
            continue;
        for (int i = 0; i < kTrials / 4; ++i) {
            std::vector<float> samples(plan.bands.size());
            const double gain = i % 50 == 0 ? 1e6 : 1;
            for (float& sample : samples)
                sample = static_cast<float>(gain * (i % 2 == 0 ? uniform(0, 1) : any_sample()));
            const Trial trial = look_at(plan, samples, StoredDepth::Half);
            Vector3 stored{};
            bool clamped = false;
            for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
                const double v = static_cast<double>(trial.sums[row]);
                clamped = clamped || std::abs(v) > 65504;
                stored[row] =
                    static_cast<double>(float_from_half(rounded_to_half(std::clamp(v, -65504.0, 65504.0))));
            }
            ASSERT_EQ(trial.budget.clamped, clamped ? 1U : 0U);
            expect_within(plan, stored, doubles(trial.sums), trial.budget.term(ErrorSource::OutputStorage));
        }
    }
}

TEST(BudgetProperty, EncodedStorageIsBoundedAsLinearLight) {
    const auto plan = plan_of(set_of(Family::T, steps(400, 10, 700)), "to=srgb&illuminant=D65").value();
    const PixelStage stage(plan.space, plan.white);
    for (const auto& [depth, largest] :
         {std::pair(StoredDepth::Uint8, 255.0), {StoredDepth::Uint16, 65535.0}})
        for (int i = 0; i < kTrials; ++i) {
            std::vector<float> samples(plan.bands.size());
            for (float& sample : samples)
                sample = static_cast<float>(uniform(-0.2, 1.3));
            const Trial trial = look_at(plan, samples, depth);
            const Vector3 encoded = stage.convert(doubles(trial.sums));
            Vector3 stored{};
            for (std::size_t c = 0; c < 3; ++c)
                stored[c] = srgb_decode(
                    std::round(std::clamp(static_cast<double>(static_cast<float>(encoded[c])), 0.0, 1.0) *
                               largest) /
                    largest);
            expect_within(plan, stored, doubles(trial.sums), trial.budget.term(ErrorSource::OutputStorage));
        }
}

TEST(BudgetProperty, PlanIsTheDistanceToTheReference) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto reference = plan_of(set, "to=lin_rec709&illuminant=FL11").value();
    const auto plan = plan_of(set, "to=lin_rec709&illuminant=FL11&basis=bins").value();
    for (int i = 0; i < kTrials; ++i) {
        std::vector<float> samples(plan.bands.size());
        std::vector<double> exact;
        for (float& sample : samples) {
            sample = static_cast<float>(uniform(0, 1));
            exact.push_back(static_cast<double>(sample));
        }
        const Trial trial = look_at(plan, samples, StoredDepth::Float, &reference);
        expect_within(plan, doubles(trial.sums), exact_sums(reference, exact),
                      trial.budget.term(ErrorSource::Plan));
        // It is a comparison, no guess: the bound is what the sums differ by, and a few roundings.
        const OutputColour colour = output_colour(plan, 1).value();
        Vector3 away{};
        const Vector3 wanted = exact_sums(reference, exact);
        for (std::size_t c = 0; c < 3; ++c)
            away[c] = std::abs(static_cast<double>(trial.sums[c]) - wanted[c]);
        Matrix3 magnitudes = colour.share_from_output;
        for (Vector3& row : magnitudes.rows)
            for (double& value : row)
                value = std::abs(value);
        const Vector3 allowed = magnitudes * away;
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_LE(trial.budget.term(ErrorSource::Plan).xyz[c], allowed[c] + 1e-5);
    }
}

TEST(BudgetProperty, TotalIsNotBelowATerm) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto reference = plan_of(set, "to=acescg&illuminant=FL2").value();
    const auto plan = plan_of(set, "to=acescg&illuminant=FL2&basis=linear").value();
    for (int i = 0; i < kTrials; ++i) {
        std::vector<std::uint16_t> samples(plan.bands.size());
        for (std::uint16_t& sample : samples)
            sample = rounded_to_half(i % 2 == 0 ? uniform(0, 1) : any_sample());
        const BudgetResult budget = look_at(plan, samples, StoredDepth::Half, &reference).budget;
        for (const ErrorSource source : kErrorSources) {
            const ErrorBound& term = budget.term(source);
            EXPECT_GT(term.delta_e_2000, 0) << error_source_name(source);
            EXPECT_LE(term.delta_e_2000, budget.total.delta_e_2000) << error_source_name(source);
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_LE(term.xyz[c], budget.total.xyz[c]) << error_source_name(source);
        }
    }
}

TEST(BudgetProperty, DeltaEBoundHoldsForEveryPairInTheBox) {
    const LabSlope slope;
    double tightest = 0;
    for (int i = 0; i < 100 * kTrials; ++i) {
        std::array<float, 3> t{}, error{};
        const double y = i % 3 == 0 ? std::exp2(uniform(-12, 4)) : uniform(0, 1);
        const double relative = std::exp2(uniform(-20, 0));
        Vector3 here{}, there{};
        for (std::size_t c = 0; c < 3; ++c) {
            const double colour = i % 2 == 0 ? uniform(-0.2, 1.5) : uniform(0.9, 1.1);
            t[c] = static_cast<float>(y * colour);
            error[c] = static_cast<float>(y * relative * uniform(0, 1));
            here[c] = static_cast<double>(t[c]);
            const double side = i % 5 == 0 ? uniform(-1, 1) : uniform(0, 1) < 0.5 ? -1 : 1;
            there[c] = here[c] + side * static_cast<double>(error[c]);
        }
        const double delta = delta_e_2000(lab_of(here, {1, 1, 1}), lab_of(there, {1, 1, 1}));
        std::array<float, 3> slopes{};
        for (std::size_t c = 0; c < 3; ++c)
            slopes[c] = slope.at_and_above(t[c] - error[c]);
        const double bound = std::sqrt(static_cast<double>(squared_delta_e_bound(slopes, error)));
        ASSERT_LE(delta, bound * (1 + 1e-6) + 1e-7) << t[0] << " " << t[1] << " " << t[2];
        if (delta > 1e-3)
            tightest = std::max(tightest, delta / bound);
    }
    EXPECT_GT(tightest, 0.4) << "the bound is of no use";
}

TEST(BudgetProperty, TheFactorOfDeltaE76IsWhatTheDerivationSays) {
    const auto share = [](double chroma) { return 1 / std::sqrt(1 + std::pow(25 / chroma, 7)); };
    double largest = 0;
    for (double c = 0.01; c < 400; c += 0.01) {
        const double g = 0.5 * (1 - share(c));
        for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double stretched = c * (1 + g * part);
            const double least = 1 + 0.015 * (1 - 0.17 - 0.24 - 0.32 - 0.20) * stretched;
            largest = std::max(largest, (1 + g) * (1 + g) * (1 + share(stretched)) / (least * least));
        }
    }
    EXPECT_LE(std::sqrt(largest), kDeltaE2000PerDeltaE76);
    EXPECT_GE(std::sqrt(largest), kDeltaE2000PerDeltaE76 - 0.01);
}

TEST(BudgetProperty, SlopesAreNotBelowTheTrueOneAndNear) {
    const LabSlope slope;
    const auto true_slope = [](double t) {
        return t <= 216.0 / 24389 ? 841.0 / 108 : std::pow(t, -2.0 / 3) / 3;
    };
    for (int i = 0; i < 100 * kTrials; ++i) {
        const auto t = static_cast<float>(i % 7 == 0 ? uniform(-1, 1) : std::exp2(uniform(-10, 15.9)));
        const double wanted = true_slope(static_cast<double>(t));
        const auto found = static_cast<double>(slope.at_and_above(t));
        ASSERT_GE(found, wanted) << t;
        ASSERT_LE(found, wanted * 1.011) << t;
    }
}

TEST(BudgetProperty, MagnitudesAreNotBelowTheReferenceAndNear) {
    for (const std::size_t bands : {1U, 2U, 31U, 81U, 471U})
        for (const std::size_t rows : {1U, 2U, 3U, 4U, 12U})
            for (const SampleMeasure measure : {SampleMeasure::Magnitude, SampleMeasure::Binade})
                for (const std::size_t pixels : {1U, 7U, 64U, 257U}) {
                    WeightMatrix weights(rows, bands);
                    for (std::size_t row = 0; row < rows; ++row)
                        for (std::size_t band = 0; band < bands; ++band)
                            weights.at(row, band) = uniform(0, 1) < 0.2 ? 0 : uniform(-1, 1);
                    std::vector<std::vector<float>> floats(bands, std::vector<float>(pixels));
                    std::vector<std::vector<std::uint16_t>> halves(bands, std::vector<std::uint16_t>(pixels));
                    std::vector<BandView> views;
                    for (std::size_t band = 0; band < bands; ++band) {
                        for (std::size_t i = 0; i < pixels; ++i) {
                            floats[band][i] = static_cast<float>(any_sample());
                            halves[band][i] = rounded_to_half(any_sample());
                        }
                        views.push_back(
                            band % 2 == 0 ? BandView{reinterpret_cast<const std::byte*>(floats[band].data()),
                                                     SampleType::Float, 4}
                                          : BandView{reinterpret_cast<const std::byte*>(halves[band].data()),
                                                     SampleType::Half, 2});
                    }
                    const MagnitudeWeights magnitudes(weights);
                    std::vector<std::vector<float>> fast(rows, std::vector<float>(pixels)), slow = fast;
                    std::vector<float*> fast_rows, slow_rows;
                    for (std::size_t row = 0; row < rows; ++row) {
                        fast_rows.push_back(fast[row].data());
                        slow_rows.push_back(slow[row].data());
                    }
                    magnitude_run(views, magnitudes, measure, pixels, fast_rows);
                    magnitude_run_reference(views, magnitudes, measure, pixels, slow_rows);
                    const double near = static_cast<double>(bands + 8) * 0x1p-22;
                    for (std::size_t row = 0; row < rows; ++row)
                        for (std::size_t i = 0; i < pixels; ++i) {
                            // Both are rounded up to float.
                            const auto wanted = static_cast<double>(slow[row][i]);
                            const auto found = static_cast<double>(fast[row][i]);
                            ASSERT_GE(found * (1 + 0x1p-23), wanted);
                            ASSERT_LE(found, wanted * (1 + near) + 0x1p-119);
                        }
                }
}

TEST(BudgetProperty, UndefinedPixelsAreCountedAndLeftOut) {
    const auto plan = plan_of(set_of(Family::T, steps(400, 10, 700)), "to=xyz&illuminant=D65").value();
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::vector<float> samples(plan.bands.size(), 0.5F);
        samples[10] = bad;
        const BudgetResult budget = look_at(plan, samples, StoredDepth::Float).budget;
        EXPECT_EQ(budget.undefined, 1U);
        EXPECT_EQ(budget.total.delta_e_2000, 0);
    }
}

TEST(BudgetProperty, WhatHasNoXyzIsRefused) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    for (const char* request : {"to=lab&illuminant=D65", "to=xyy&illuminant=D65"}) {
        const CollapsePlan plan = plan_of(set, request).value();
        EXPECT_FALSE(ErrorBudget::create({plan, {}}));
    }
    const CollapsePlan plan = plan_of(set, "to=srgb&illuminant=D65").value();
    BudgetSubject subject{plan, std::vector<SampleType>(31, SampleType::Half)};
    EXPECT_TRUE(ErrorBudget::create(subject));
    subject.has_alpha = true;
    EXPECT_FALSE(ErrorBudget::create(subject));
}

}  // namespace
}  // namespace osio
