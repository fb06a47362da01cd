// SPDX-License-Identifier: Apache-2.0
//
// Laws that hold for any spectrum on any grid in any basis, over random ones, pixels by both executors.
#include <osio/base/text.h>

#include <support/bound.h>
#include <support/executed.h>
#include <support/sets.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace osio::test {
namespace {

struct Sample {
    std::vector<double> nm;
    std::string request;
    std::vector<float> a, b;
};

/// Equal steps for bases that need them, any wavelengths otherwise; samples from -1 to 2.
Sample sample(std::mt19937& random) {
    const std::vector<std::string> bases{"linear", "bins", "e2022", "sprague", "bins-corrected"};
    const std::vector<std::string> spaces{"xyz", "lin_rec709", "acescg", "luminance"};
    const std::size_t basis = random() % bases.size();
    const std::size_t count = 6 + random() % 40;
    std::uniform_real_distribution<double> place(340, 850);
    Sample out;
    if (basis >= 3) {
        const double first = 360 + static_cast<double>(random() % 50);
        const double step = 2 + static_cast<double>(random() % 9);
        out.nm = steps(first, step, first + step * static_cast<double>(count - 1));
    } else {
        while (out.nm.size() < count)
            out.nm.push_back(place(random));
    }
    out.request = "basis=" + bases[basis] + "&to=" + spaces[random() % spaces.size()];
    std::uniform_real_distribution<float> value(-1, 2);
    for (std::size_t i = 0; i < out.nm.size(); ++i) {
        out.a.push_back(value(random));
        out.b.push_back(value(random));
    }
    return out;
}

double largest(const CollapsePlan& plan, const std::vector<float>& samples) {
    double most = 0;
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        double sum = 0;
        for (std::size_t band = 0; band < plan.bands.size(); ++band)
            sum +=
                std::abs(plan.weights.at(row, band) * static_cast<double>(samples[plan.bands[band].channel]));
        most = std::max(most, sum);
    }
    return most;
}

/// f(a + b / 2) = f(a) + f(b) / 2, to the rounding of three floats.
TEST(Law, PixelsAreLinearInTheirSpectra) {
    std::mt19937 random(101);
    Bound bound("linearity, share of the largest sum of absolute terms", 3e-7);
    for (int i = 0; i < 300; ++i) {
        const Sample s = sample(random);
        const auto plan = plan_of(set_of(Family::S0, s.nm), s.request).value();
        std::vector<float> mixed;
        for (std::size_t k = 0; k < s.a.size(); ++k)
            mixed.push_back(s.a[k] + s.b[k] / 2);
        const auto a = executed(plan, s.a), b = executed(plan, s.b), both = executed(plan, mixed);
        const double most = largest(plan, s.a) + largest(plan, s.b);
        for (std::size_t row = 0; row < both.size(); ++row)
            bound.see_absolute(static_cast<double>(both[row]) / most,
                               (static_cast<double>(a[row]) + static_cast<double>(b[row]) / 2) / most,
                               s.request);
    }
}

/// A power of two passes through every multiplication and addition unrounded.
TEST(Law, ScalingByAPowerOfTwoIsExact) {
    std::mt19937 random(102);
    for (int i = 0; i < 200; ++i) {
        const Sample s = sample(random);
        const auto plan = plan_of(set_of(Family::S0, s.nm), s.request).value();
        for (const float scale : {0x1p-20F, 0x1p40F}) {
            std::vector<float> scaled = s.a;
            for (float& value : scaled)
                value *= scale;
            auto expected = executed(plan, s.a);
            for (float& value : expected)
                value *= scale;
            EXPECT_EQ(executed(plan, scaled), expected) << s.request;
        }
    }
}

TEST(Law, TheOrderOfChannelsIsNoMatter) {
    std::mt19937 random(103);
    for (int i = 0; i < 200; ++i) {
        const Sample s = sample(random);
        std::vector<std::size_t> order(s.nm.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::shuffle(order.begin(), order.end(), random);
        Sample shuffled = s;
        for (std::size_t k = 0; k < order.size(); ++k) {
            shuffled.nm[k] = s.nm[order[k]];
            shuffled.a[k] = s.a[order[k]];
        }
        const auto plan = plan_of(set_of(Family::S0, s.nm), s.request).value();
        const auto other = plan_of(set_of(Family::S0, shuffled.nm), s.request).value();
        EXPECT_EQ(plan.id, other.id);
        EXPECT_EQ(executed(plan, s.a), executed(other, shuffled.a)) << s.request;
    }
}

/// A band that is there several times, with any values, counts as their mean.
TEST(Law, SplittingABandIntoSeveralOfOneWavelengthChangesNothing) {
    std::mt19937 random(104);
    Bound bound("a band in pieces, share of the largest sum of absolute terms", 1.8e-7);
    for (int i = 0; i < 200; ++i) {
        const Sample s = sample(random);
        const std::size_t at = random() % s.nm.size();
        const auto pieces = static_cast<int>(2 + random() % 3);
        std::vector<std::string> names;
        std::vector<float> split = s.a;
        for (const double nm : s.nm)
            names.push_back("S0." + format_wavelength(nm, DecimalMark::Comma));
        for (int k = 1; k < pieces; ++k) {
            names.push_back("S0." + std::string(static_cast<std::size_t>(k), '0') +
                            format_wavelength(s.nm[at], DecimalMark::Comma));
            // Pairs that lie as far above the value as below it.
            const bool paired = k + 1 < pieces || k % 2 == 0;
            split.push_back(s.a[at] + (paired ? (k % 2 == 1 ? 0.25F : -0.25F) : 0));
        }
        const auto plan = plan_of(set_of(Family::S0, s.nm), s.request).value();
        const auto other =
            plan_of(parse_channel_layout(names, DecimalMark::Comma).sets.at(0), s.request).value();
        const auto whole = executed(plan, s.a), parts = executed(other, split);
        const double most = largest(other, split);
        for (std::size_t row = 0; row < whole.size(); ++row)
            bound.see_absolute(static_cast<double>(parts[row]) / most, static_cast<double>(whole[row]) / most,
                               s.request);
    }
}

}  // namespace
}  // namespace osio::test
