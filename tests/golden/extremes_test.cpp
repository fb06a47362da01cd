// SPDX-License-Identifier: Apache-2.0
//
// Spectra and lights at the edge of what numbers can say, through plans and both executors. What is
// finite in tests/golden/extremes.csv is compared in weights_test.cpp; tests/e2e/test_extremes.py drives
// the same cases through the tool and the plugin.
#include <osio/collapse/pixel_stage.h>
#include <osio/colour/illuminant.h>

#include <support/bound.h>
#include <support/csv.h>
#include <support/executed.h>
#include <support/sets.h>

#include <cmath>
#include <limits>

namespace osio::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

const std::vector<double> kSeven = steps(400, 50, 700);

CollapsePlan radiance_plan(const std::vector<double>& nm, const std::string& request) {
    return plan_of(set_of(Family::S0, nm), "basis=linear&" + request).value();
}

std::vector<float> floats(const std::vector<double>& values) {
    return {values.begin(), values.end()};
}

TEST(Extremes, NanAndInfinityStayInTheirPixel) {
    for (const std::string to : {"xyz", "lin_rec709", "luminance"}) {
        const auto plan = radiance_plan(kSeven, "to=" + to);
        for (const float out : executed(plan, {1, 1, 1, kNan, 1, 1, 1}))
            EXPECT_TRUE(std::isnan(out)) << to;
        // One infinite band is infinite in every output, with the sign of the band's weight.
        const auto infinite = executed(plan, {1, 1, 1, kInf, 1, 1, 1});
        for (std::size_t row = 0; row < infinite.size(); ++row)
            EXPECT_EQ(infinite[row], plan.weights.at(row, 3) > 0 ? kInf : -kInf) << to;
    }
    // Weights of both signs meet an infinite pixel: infinity minus infinity.
    const auto rgb = radiance_plan(kSeven, "to=lin_rec709");
    EXPECT_TRUE(std::isnan(executed(rgb, std::vector<float>(7, kInf))[0]));
    EXPECT_EQ(executed(radiance_plan(kSeven, "to=xyz"), std::vector<float>(7, kInf)),
              (std::vector<float>{kInf, kInf, kInf}));
}

TEST(Extremes, WhatHasNoWeightDoesNoHarm) {
    const auto plan = radiance_plan({400, 500, 600, 700, 831, 900}, "to=xyz");
    const auto clean = executed(plan, {1, 1, 1, 1, 1, 1});
    EXPECT_EQ(executed(plan, {1, 1, 1, 1, 1, kNan}), clean);
    EXPECT_EQ(executed(plan, {1, 1, 1, 1, 1, kInf}), clean);
}

TEST(Extremes, TinyAndHugeRadiance) {
    const auto xyz = radiance_plan(kSeven, "to=xyz");
    const double flat = outputs_of(xyz, std::vector<double>(7, 1.0))[0];
    Bound tiny("denormal radiance, absolute error in quanta of 1.4e-45", 1);
    for (const float value : {1e-40F, 1e-44F, 1e-30F})
        tiny.see_absolute(static_cast<double>(executed(xyz, std::vector<float>(7, value))[0]) /
                              std::max(1.401298464324817e-45, 6e-8 * static_cast<double>(value)),
                          flat * static_cast<double>(value) /
                              std::max(1.401298464324817e-45, 6e-8 * static_cast<double>(value)),
                          std::to_string(std::log10(static_cast<double>(value))));
    Bound huge("huge radiance, relative error", 2e-6);
    for (const float value : {1e38F, 3e38F, 65504.0F})
        huge.see_relative(static_cast<double>(executed(xyz, std::vector<float>(7, value))[0]),
                          flat * static_cast<double>(value), std::to_string(static_cast<double>(value)));
    // RGB may leave the range of a float, never for NaN.
    for (const std::string to : {"lin_rec709", "aces2065_1"})
        for (const float out :
             executed(radiance_plan(kSeven, "to=" + to), {3e38F, 0, 3e38F, 0, 3e38F, 3e38F, 3e38F}))
            EXPECT_FALSE(std::isnan(out)) << to;
}

TEST(Extremes, BlackIsZeroInEverySpaceAndHasTheWhitesChromaticity) {
    for (const OutputSpace& space : output_spaces()) {
        if (space.kind == SpaceKind::Camera || space.kind == SpaceKind::Display ||
            is_polarisation(space.kind) || (is_polarimetric(space.kind) && space.kind != SpaceKind::S0))
            continue;  // need tables of the user's; other sets of bands
        const auto plan = radiance_plan(kSeven, "to=" + std::string(space.id));
        const auto sums = executed(plan, std::vector<float>(7, 0.0F));
        for (const float sum : sums)
            EXPECT_EQ(sum, 0.0F) << space.id;
        if (sums.size() != 3)
            continue;
        const Vector3 out = PixelStage(plan.space, plan.white).convert({0, 0, 0});
        const double white = plan.white[0] + plan.white[1] + plan.white[2];
        if (space.kind == SpaceKind::XyY) {
            EXPECT_DOUBLE_EQ(out[0], plan.white[0] / white);
            EXPECT_DOUBLE_EQ(out[1], plan.white[1] / white);
            EXPECT_EQ(out[2], 0);
        } else if (space.kind != SpaceKind::Uv) {
            EXPECT_EQ(out, (Vector3{0, 0, 0})) << space.id;
        }
    }
}

/// Thousands of bands say the same as the samples at 1 nm, and adding them up loses nothing. The curve of
/// an observer is straight between whole nanometres, so the integral of f against it is a sum over hats:
/// f(i) + f''/12 each, and half a hat at both ends. Hence the bound, of f'' against the smallest f; a
/// tenth more is for the straight lines between bands.
TEST(Extremes, ThousandsOfBandsEqualTheSumAtOneNanometre) {
    Bound rule("many bands against 1 nm, as a share of what f'' allows", 1),
        pixels("their pixels, relative", 2e-6);
    for (const double period : {17.0, 100.0, 300.0}) {
        const auto curve = [&](double nm) { return 0.5 + 0.4 * std::sin(nm / period); };
        const double allowed = 1.1 * (0.4 / (period * period)) / 12 / 0.1;
        std::vector<double> values;
        for (const double nm : steps(360, 1, 830))
            values.push_back(curve(nm));
        const auto whole = radiance_plan(steps(360, 1, 830), "to=xyz");
        auto expected = outputs_of(whole, values);
        for (std::size_t row = 0; row < 3; ++row)
            for (const std::size_t end : {std::size_t{0}, values.size() - 1})
                expected[row] -= whole.weights.at(row, end) * values[end] / 2;
        for (const int count : {5000, 20001}) {
            std::vector<double> nm;
            values.clear();
            for (int i = 0; i < count; ++i) {
                nm.push_back(360 + 470.0 * i / (count - 1));
                values.push_back(curve(nm.back()));
            }
            const auto plan = radiance_plan(nm, "to=xyz");
            EXPECT_EQ(plan.quadrature, Quadrature::Exact);
            const auto sums = outputs_of(plan, values);
            const auto pixel = executed(plan, floats(values));
            const std::string where = std::to_string(count) + " bands, period " + std::to_string(period);
            for (std::size_t row = 0; row < 3; ++row) {
                rule.see_absolute((sums[row] / expected[row] - 1) / allowed, 0, where);
                pixels.see_relative(static_cast<double>(pixel[row]), sums[row], where);
            }
        }
    }
}

/// Channels that cancel are known to 1e-6 of the largest one, not of themselves.
TEST(Extremes, SaturatedColoursCancelToAShareOfTheLargestChannel) {
    const auto nm = steps(380, 5, 780);
    Bound bound("saturated RGB, share of the largest channel", 1e-6);
    for (const std::string to : {"lin_rec709", "acescg", "aces2065_1"}) {
        const auto plan = radiance_plan(nm, "to=" + to);
        for (std::size_t line = 0; line + 1 < nm.size(); ++line) {
            std::vector<double> samples(nm.size(), 0);
            samples[line] = 0.37;
            samples[line + 1] = 0.91;
            const auto exact = outputs_of(plan, samples);
            const auto pixel = executed(plan, floats(samples), 0);
            const double most = std::max({std::abs(exact[0]), std::abs(exact[1]), std::abs(exact[2])});
            for (std::size_t row = 0; row < 3; ++row)
                bound.see_absolute(static_cast<double>(pixel[row]) / most, exact[row] / most,
                                   to + " " + std::to_string(nm[line]));
        }
    }
}

std::string said_of(const std::vector<double>& nm, const std::string& request, const std::string& light) {
    const auto plan = make_plan(set_of(Family::T, nm), request_of("illuminant=lamp.csv&" + request),
                                [&](std::string_view) -> Result<std::string> { return light; });
    return plan ? "a plan" : plan.error().text();
}

TEST(Extremes, LightsThatShineNowhereOrElsewhereAreErrors) {
    EXPECT_EQ(said_of(kSeven, "to=xyz", "380,0\n780,0\n"),
              "lamp.csv: no power at any whole nanometre of 360-830 nm (the table covers 380-780 nm)");
    for (const std::string extrapolate : {"hold", "zero"}) {
        const std::string request = "to=xyz&basis=linear&extrapolate=" + extrapolate;
        const auto reds = steps(600, 10, 700);
        EXPECT_EQ(said_of(reds, request, "380,1\n580,1\n"),
                  "lamp.csv: the light has no power over 600-700 nm, which is what the bands of set T say "
                  "something of: all of the result would be extrapolated; use another light, or bands where "
                  "it shines");
        EXPECT_EQ(said_of(reds, request, "380,1\n600,1\n"), "a plan");
        EXPECT_EQ(said_of(reds, request, "380,1\n599.5,1\n605,0\n"), "a plan");
    }
    // One wavelength says the same of all others.
    EXPECT_EQ(said_of({550}, "to=xyz", "600,1\n700,1\n"), "a plan");
    EXPECT_EQ(said_of({550.5}, "to=xyz", "380,1\n780,1\n"), "a plan");
    // The observer of 2015 begins at 390 nm: a lamp that ends there has power and no luminance.
    EXPECT_EQ(said_of(steps(360, 10, 700), "to=xyz&observer=cie2015_2deg", "360,1\n380,1\n").substr(0, 36),
              "lamp.csv: the light has no luminance");
}

TEST(Extremes, OneBandHasTheWidthThatItsFileStates) {
    const auto one = set_of(Family::S0, {550});
    const auto two = set_of(Family::S0, {545, 555});
    SpectralMetadata bin, halves, width;
    bin.bin_edges_nm = {540, 560};
    halves.bin_edges_nm = {540, 550, 560};
    width.fwhm = Spectrum{{550}, {20}};
    Bound bound("one bin against its halves", 1e-12);
    for (const std::string extrapolate : {"hold", "zero"}) {
        const auto request = request_of("to=xyz&extrapolate=" + extrapolate);
        const auto whole = make_plan(one, bin, request, no_files).value();
        const auto parts = make_plan(two, halves, request, no_files).value();
        for (std::size_t row = 0; row < 3; ++row)
            bound.see_relative(parts.weights.at(row, 0) + parts.weights.at(row, 1), whole.weights.at(row, 0),
                               extrapolate);
        EXPECT_EQ(whole.basis.basis, Basis::Bins);
    }
    const auto flat = make_plan(one, width, request_of("to=xyz"), no_files).value();
    EXPECT_NEAR(flat.weights.at(1, 0), 1, 1e-12);
    EXPECT_EQ(flat.warnings.at(0), "basis=response needs 2 bands and there are 1: straight lines are used");
    EXPECT_FALSE(make_plan(one, width, request_of("to=xyz&extrapolate=zero"), no_files));
    EXPECT_FALSE(plan_of(one, "to=xyz&extrapolate=zero"));
}

/// As samples a gap is bridged by a straight line; as bins its neighbours reach to its middle.
TEST(Extremes, GapsAreBridged) {
    const std::vector<double> gap{400, 410, 420, 430, 600, 610, 620, 630};
    std::vector<double> full, line, halves;
    for (const double nm : steps(400, 10, 630)) {
        full.push_back(nm);
        const double t = std::clamp((nm - 430) / 170, 0.0, 1.0);
        line.push_back(0.2 + 0.6 * t);
        halves.push_back(nm < 515 ? 0.2 : 0.8);
    }
    const std::vector<double> samples{0.2, 0.2, 0.2, 0.2, 0.8, 0.8, 0.8, 0.8};
    Bound bound("a gap against the bands that bridge it", 1e-12);
    const auto compare = [&](const std::string& basis, const std::vector<double>& bridged) {
        const auto with =
            outputs_of(plan_of(set_of(Family::S0, gap), "to=xyz&basis=" + basis).value(), samples);
        const auto without =
            outputs_of(plan_of(set_of(Family::S0, full), "to=xyz&basis=" + basis).value(), bridged);
        for (std::size_t row = 0; row < 3; ++row)
            bound.see_relative(with[row], without[row], basis);
    };
    compare("linear", line);
    compare("bins", halves);
}

}  // namespace
}  // namespace osio::test
