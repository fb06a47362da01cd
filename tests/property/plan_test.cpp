// SPDX-License-Identifier: Apache-2.0
//
// Laws of a plan, over random and chosen grids.
#include <osio/base/text.h>
#include <osio/colour/illuminant.h>

#include <support/bound.h>
#include <support/sets.h>

#include <algorithm>
#include <random>

namespace osio::test {
namespace {

std::vector<double> random_grid(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> nm(340, 850);
    std::vector<double> grid;
    while (static_cast<int>(grid.size()) < count)
        grid.push_back(nm(random));
    std::sort(grid.begin(), grid.end());
    grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
    return grid;
}

double largest(const std::vector<double>& values) {
    double out = 0;
    for (const double v : values)
        out = std::max(out, std::abs(v));
    return out;
}

TEST(Plan, PerfectDiffuserIsWhiteInEverySpaceUnderEveryLight) {
    Bound bound("diffuser in RGB and Y", 1e-12);
    for (const std::string& light : illuminant_names())
        for (const OutputSpace& space : output_spaces()) {
            if (space.kind == SpaceKind::Camera || space.kind == SpaceKind::Display ||
                is_polarimetric(space.kind))
                continue;  // need tables of the user's; no space of a reflectance
            for (const auto& grid : {steps(380, 5, 780), steps(400, 10, 700), steps(360, 1, 830)}) {
                const auto plan =
                    plan_of(set_of(Family::T, grid), "to=" + std::string(space.id) + "&illuminant=" + light)
                        .value();
                const auto out = outputs_of(plan, std::vector<double>(grid.size(), 1.0));
                if (space.kind == SpaceKind::Rgb)
                    for (const double channel : out)
                        bound.see_absolute(channel, 1, light + " " + std::string(space.id));
                else
                    bound.see_absolute(out[space.kind == SpaceKind::Luminance ? 0 : 1], 1,
                                       light + " " + std::string(space.id));
                if (space.kind == SpaceKind::XyzD65) {
                    bound.see_absolute(out[0], kD65.xyz()[0], light + " X");
                    bound.see_absolute(out[2], kD65.xyz()[2], light + " Z");
                }
            }
        }
}

TEST(Plan, FlatRadianceOfOneHasUnitY) {
    for (const char* observer : {"cie1931", "cie1964"}) {
        const auto plan =
            plan_of(set_of(Family::S0, steps(400, 10, 700)), std::string("to=xyz&observer=") + observer);
        EXPECT_NEAR(outputs_of(*plan, std::vector<double>(31, 1.0))[1], 1, 1e-13) << observer;
    }
}

TEST(Plan, OneBandStandsForAFlatSpectrum) {
    const auto one = plan_of(set_of(Family::S0, {550}), "to=xyz").value();
    const auto flat = plan_of(set_of(Family::S0, {360, 830}), "to=xyz").value();
    for (std::size_t row = 0; row < 3; ++row)
        EXPECT_NEAR(one.weights.at(row, 0), flat.weights.at(row, 0) + flat.weights.at(row, 1), 1e-13);
}

TEST(Plan, WeightsDoNotDependOnTheOrderOfChannels) {
    std::mt19937 random(5);
    for (int i = 0; i < 50; ++i) {
        auto grid = random_grid(random, 20);
        const auto sorted = plan_of(set_of(Family::S0, grid), "to=acescg").value();
        std::shuffle(grid.begin(), grid.end(), random);
        const auto shuffled = plan_of(set_of(Family::S0, grid), "to=acescg").value();
        for (std::size_t row = 0; row < 3; ++row)
            EXPECT_TRUE(std::ranges::equal(sorted.weights.row(row), shuffled.weights.row(row)));
        EXPECT_EQ(sorted.id, shuffled.id);
    }
}

TEST(Plan, ASampleOnTheLineBetweenItsNeighboursChangesNothing) {
    std::mt19937 random(17);
    Bound bound("change by a collinear sample, share of the largest output", 1e-12);
    std::uniform_real_distribution<double> value(0, 1);
    for (int i = 0; i < 200; ++i) {
        auto grid = random_grid(random, 12);
        std::vector<double> samples;
        for (std::size_t k = 0; k < grid.size(); ++k)
            samples.push_back(value(random));
        const std::size_t at = 1 + random() % (grid.size() - 1);
        const double t = value(random);
        const double nm = grid[at - 1] + t * (grid[at] - grid[at - 1]);
        // The 1 nm sum and the exact integral are different rules: compare within one.
        if (nm - grid[at - 1] < 1 || grid[at] - nm < 1)
            continue;
        auto more_grid = grid;
        auto more_samples = samples;
        const auto offset = static_cast<std::ptrdiff_t>(at);
        more_grid.insert(more_grid.begin() + offset, nm);
        more_samples.insert(more_samples.begin() + offset,
                            samples[at - 1] + t * (samples[at] - samples[at - 1]));
        const auto before = plan_of(set_of(Family::S0, grid), "to=xyz&basis=linear").value();
        const auto after = plan_of(set_of(Family::S0, more_grid), "to=xyz&basis=linear").value();
        const auto a = outputs_of(before, samples), b = outputs_of(after, more_samples);
        if (before.quadrature != after.quadrature)
            continue;
        for (std::size_t row = 0; row < 3; ++row)
            bound.see_absolute(a[row] / largest(a), b[row] / largest(a), "grid " + std::to_string(i));
    }
}

TEST(Plan, LinearlyReproducesStraightLinesThroughAnyGrid) {
    // A straight line over wavelength is the same spectrum on every grid that covers 360-830 nm.
    std::mt19937 random(23);
    const auto line = [](double nm) { return 0.2 + 0.001 * (nm - 360); };
    const auto reference = plan_of(set_of(Family::S0, steps(360, 1, 830)), "to=xyz&basis=linear").value();
    std::vector<double> samples;
    for (const double nm : steps(360, 1, 830))
        samples.push_back(line(nm));
    const auto expected = outputs_of(reference, samples);
    Bound bound("straight line on a random grid", 1e-12);
    for (int i = 0; i < 100; ++i) {
        std::vector<double> grid{355, 835};
        std::uniform_int_distribution<int> nm(360, 830);
        for (int k = 0; k < 15; ++k)
            grid.push_back(nm(random));
        std::sort(grid.begin(), grid.end());
        grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
        samples.clear();
        for (const double l : grid)
            samples.push_back(line(l));
        const auto out =
            outputs_of(plan_of(set_of(Family::S0, grid), "to=xyz&basis=linear").value(), samples);
        for (std::size_t row = 0; row < 3; ++row)
            bound.see_relative(out[row], expected[row], std::to_string(i));
    }
}

TEST(Plan, BandsOfOneWavelengthShareItsWeight) {
    const std::vector<std::string> names{"T.400nm", "T.500nm", "T.5e2nm", "T.600nm"};
    const auto set = parse_channel_layout(names, DecimalMark::Comma).sets.at(0);
    const auto twice = plan_of(set, "to=xyz&illuminant=D65").value();
    const auto once = plan_of(set_of(Family::T, {400, 500, 600}), "to=xyz&illuminant=D65").value();
    for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_DOUBLE_EQ(twice.weights.at(row, 1), once.weights.at(row, 1) / 2);
        EXPECT_DOUBLE_EQ(twice.weights.at(row, 2), once.weights.at(row, 1) / 2);
        EXPECT_DOUBLE_EQ(twice.weights.at(row, 3), once.weights.at(row, 2));
    }
}

TEST(Plan, ExposureIsAPowerOfTwo) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto plain = plan_of(set, "to=srgb&illuminant=A").value();
    const auto brighter = plan_of(set, "to=srgb&illuminant=A&exposure=3").value();
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t band = 0; band < plain.bands.size(); ++band)
            EXPECT_DOUBLE_EQ(brighter.weights.at(row, band), 8 * plain.weights.at(row, band));
}

TEST(Plan, TheLightsScaleDoesNotMatter) {
    const auto light = [](const std::string& scale) {
        return [scale](std::string_view) -> Result<std::string> {
            return "380," + scale + "\n560," + scale + "0\n780," + scale + "00\n";
        };
    };
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto request = request_of("to=lin_rec709&illuminant=lamp.csv");
    const auto dim = make_plan(set, request, light("1")).value();
    const auto bright = make_plan(set, request, light("1000")).value();
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t band = 0; band < dim.bands.size(); ++band)
            EXPECT_NEAR(dim.weights.at(row, band), bright.weights.at(row, band), 1e-15);
}

TEST(Plan, RadianceCountsAsD65Referred) {
    const auto set = set_of(Family::S0, steps(400, 10, 700));
    const auto xyz = plan_of(set, "to=xyz").value();
    const auto d65 = plan_of(set, "to=xyz_d65").value();
    const auto white = plan_of(set, "to=xyz_d65&white=0.3127,0.3290").value();
    for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_TRUE(std::ranges::equal(xyz.weights.row(row), d65.weights.row(row)));
        EXPECT_TRUE(std::ranges::equal(xyz.weights.row(row), white.weights.row(row)));
    }
}

TEST(Plan, AStatedWhiteBecomesTheSpacesWhite) {
    const auto set = set_of(Family::S0, steps(400, 10, 700));
    const auto plan = plan_of(set, "to=acescg&white=A").value();
    const Matrix3 xyz_from_acescg = xyz_from_rgb(find_output_space("acescg").value());
    // A radiance whose XYZ is A's white: solve for it in weights instead of spectra.
    const auto xyz = plan_of(set, "to=xyz").value();
    const Vector3 white = white_point(find_illuminant("A").value(), find_observer("cie1931").value()).value();
    const Matrix3 to_acescg =
        inverse(xyz_from_acescg) * adaptation_matrix(Adaptation::Bradford, white, kAcesWhite.xyz()).value();
    for (std::size_t band = 0; band < plan.bands.size(); ++band) {
        const Vector3 expected =
            to_acescg * Vector3{xyz.weights.at(0, band), xyz.weights.at(1, band), xyz.weights.at(2, band)};
        for (std::size_t row = 0; row < 3; ++row)
            EXPECT_NEAR(plan.weights.at(row, band), expected[row], 1e-15);
    }
}

TEST(Plan, EqualRequestsHaveEqualIdsAndOthersHaveOthers) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto id = [&](const std::string& request) { return plan_of(set, request)->id; };
    EXPECT_EQ(id("to=acescg&illuminant=D65"), id("illuminant=d65&to=ACEScg"));
    EXPECT_NE(id("to=acescg&illuminant=D65"), id("to=acescg&illuminant=D50"));
    EXPECT_NE(id("to=acescg&illuminant=D65"), id("to=acescg&illuminant=D65&exposure=1"));
    EXPECT_NE(id("to=acescg&illuminant=D65"), id("to=acescg&illuminant=D65&extrapolate=zero"));
    EXPECT_NE(plan_of(set_of(Family::T, steps(400, 20, 700)), "to=acescg&illuminant=D65")->id,
              id("to=acescg&illuminant=D65"));
}

TEST(Plan, FineBandsAreIntegratedExactlyAndCoarseOnesSummed) {
    const auto rule = [](const std::vector<double>& grid) {
        return plan_of(set_of(Family::S0, grid), "to=xyz&basis=linear")->quadrature;
    };
    EXPECT_EQ(rule(steps(380, 1, 780)), Quadrature::Sum1nm);
    EXPECT_EQ(rule(steps(380, 0.5, 780)), Quadrature::Exact);
    EXPECT_EQ(rule({400, 500, 500.9, 600}), Quadrature::Exact);
    EXPECT_EQ(rule({100, 100.5, 400, 700, 900, 900.5}), Quadrature::Sum1nm);  // fine only outside
    EXPECT_EQ(rule({550}), Quadrature::Sum1nm);
}

/// The two rules differ by the half weights that the integral gives to 360 and 830 nm and by the
/// curvature between whole nanometres: below 1e-4 for what varies over tens of nanometres.
TEST(Plan, ExactIntegralAndSumAgreeOnSmoothSpectra) {
    const auto sum = plan_of(set_of(Family::S0, steps(360, 1, 830)), "to=xyz&basis=linear").value();
    const auto exact = plan_of(set_of(Family::S0, steps(360, 0.5, 830)), "to=xyz&basis=linear").value();
    const auto smooth = [](double nm) { return 1 + 0.5 * std::sin(nm / 40); };
    std::vector<double> at_1nm, at_half_nm;
    for (const double nm : steps(360, 1, 830))
        at_1nm.push_back(smooth(nm));
    for (const double nm : steps(360, 0.5, 830))
        at_half_nm.push_back(smooth(nm));
    const auto a = outputs_of(sum, at_1nm), b = outputs_of(exact, at_half_nm);
    for (std::size_t row = 0; row < 3; ++row)
        EXPECT_NEAR(a[row], b[row], 1e-4 * b[row]);
}

std::string refusal(const SpectralSet& set, const std::string& request) {
    const auto plan = plan_of(set, request);
    return plan ? "no refusal" : plan.error().text();
}

TEST(PlanRefusal, NamesWhatWasFoundExpectedAndToDo) {
    const auto reflectance = set_of(Family::T, steps(400, 10, 700));
    const auto radiance = set_of(Family::S0, steps(400, 10, 700));
    EXPECT_EQ(refusal(reflectance, "to=xyz"),
              "set T is a reflectance, which has no colour without a light; name one with "
              "illuminant=D65 (osiotool list illuminants)");
    EXPECT_EQ(refusal(radiance, "to=xyz&illuminant=D65"),
              "set S0 is a radiance, which already holds its light; leave illuminant=D65 out");
    EXPECT_EQ(refusal(set_of(Family::S0, {200, 300, 350}), "to=xyz"),
              "the bands of set S0 cover 200-350 nm, nothing of the 360-830 nm that an observer sees");
    EXPECT_EQ(refusal(set_of(Family::S0, {831, 900}), "to=xyz"),
              "the bands of set S0 cover 831-900 nm, nothing of the 360-830 nm that an observer sees");
    EXPECT_EQ(refusal(set_of(Family::S0, {550}), "to=xyz&extrapolate=zero"),
              "set S0 has one wavelength, 550 nm: with extrapolate=zero its spectrum has no width; "
              "use extrapolate=hold");
    EXPECT_EQ(refusal(reflectance, "to=lin_rec709&illuminant=D56"),
              "no illuminant is called \"D56\"; did you mean \"D50\"? (a table of your own is named "
              "by its path and ends in .csv)");
    EXPECT_EQ(refusal(radiance, "to=xyz&white=D65"),
              "white=D65 does not fit to=xyz, which is not adapted; use to=xyz_d65");
    EXPECT_EQ(refusal(radiance, "to=xyz_d65&white=0.3,0.8"),
              "white \"0.3,0.8\" is no chromaticity: expected x,y with x > 0, y > 0 and x + y <= 1, "
              "such as 0.3127,0.3290");
    EXPECT_EQ(refusal(radiance, "to=acescg&names=xyz"),
              "names=xyz does not fit to=acescg, whose values are red, green and blue");
    EXPECT_EQ(refusal(radiance, "illuminant=D65").substr(0, 42),
              "no space to collapse to was named; use to=");
}

TEST(PlanRefusal, LightsWithoutLuminance) {
    const auto with = [](const std::string& csv) {
        const auto plan =
            make_plan(set_of(Family::T, steps(400, 10, 700)), request_of("to=xyz&illuminant=lamp.csv"),
                      [csv](std::string_view) -> Result<std::string> { return csv; });
        return plan ? std::string("no refusal") : plan.error().text();
    };
    EXPECT_EQ(with("400,0\n700,0\n"),
              "lamp.csv: no power at any whole nanometre of 360-830 nm (the table covers 400-700 nm)");
    EXPECT_EQ(with("200,1\n300,1\n"),
              "lamp.csv: no power at any whole nanometre of 360-830 nm (the table covers 200-300 nm)");
    EXPECT_EQ(with("400,1\n500,-1\n"),
              "lamp.csv: the power -1 at 500 nm is negative; a light has none below zero");
    EXPECT_EQ(with("400,1\n700,1\n"), "no refusal");
}

TEST(PlanWarning, ExtrapolatedNanometresAreToldAndMuchOfThemByOutput) {
    const auto warnings = [](const std::vector<double>& grid) {
        return plan_of(set_of(Family::S0, grid), "to=xyz&basis=linear")->warnings;
    };
    EXPECT_TRUE(warnings(steps(360, 10, 830)).empty());
    EXPECT_EQ(warnings(steps(400, 10, 700)).at(0).substr(0, 83),
              "40 nm below and 130 nm above the bands are extrapolated (hold): at most 0.49 % of a");
    EXPECT_EQ(warnings({300, 350, 400}).at(0).substr(0, 76),
              "0 nm below and 430 nm above the bands are extrapolated (hold): much of the w");
}

TEST(PlanWarning, SharesAreTheWeightBeyondTheBands) {
    const auto set = set_of(Family::S0, steps(450, 10, 650));
    const auto hold = plan_of(set, "to=xyz&basis=linear").value();
    const auto zero = plan_of(set, "to=xyz&basis=linear&extrapolate=zero").value();
    // For XYZ every weight is positive: what zero loses of a flat spectrum is the share of hold.
    for (std::size_t row = 0; row < 3; ++row) {
        const double all = outputs_of(hold, std::vector<double>(21, 1.0))[row];
        const double inside = outputs_of(zero, std::vector<double>(21, 1.0))[row];
        EXPECT_NEAR(hold.extrapolated_share[row], (all - inside) / all, 1e-12);
        EXPECT_EQ(hold.extrapolated_share[row], zero.extrapolated_share[row]);
    }
}

TEST(Plan, RelightingWithNoBandsInsideTheLightStillDecides) {
    // HP1's table ends at 780 nm, bands may go on: the light is zero there and so are the weights.
    const auto plan = plan_of(set_of(Family::T, steps(380, 10, 900)), "to=xyz&illuminant=HP1").value();
    EXPECT_EQ(plan.weights.at(0, plan.bands.size() - 1), 0);
    EXPECT_FALSE(plan.weights.needs(plan.bands.size() - 1));
}

}  // namespace
}  // namespace osio::test
