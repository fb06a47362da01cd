// SPDX-License-Identifier: Apache-2.0
//
// Fluorescence: the weights of pairs against the Donaldson matrix evaluated band by band, and laws.
#include <osio/colour/daylight.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/planckian.h>

#include <support/bound.h>
#include <support/executed.h>
#include <support/sets.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace osio::test {
namespace {

using Pair = std::pair<double, double>;

/// A set with bands and pairs, channels in this order.
SpectralSet fluorescent(const std::vector<double>& bands, const std::vector<Pair>& pairs) {
    std::vector<std::string> names;
    for (const double nm : bands)
        names.push_back(format_channel_name({"", Family::T, nm, {}}, DecimalMark::Comma));
    for (const auto& [in, out] : pairs)
        names.push_back(format_channel_name({"", Family::T, in, out}, DecimalMark::Comma));
    return parse_channel_layout(names, DecimalMark::Comma).sets.at(0);
}

/// Every pair above the diagonal of a grid.
std::vector<Pair> triangle(const std::vector<double>& grid) {
    std::vector<Pair> out;
    for (std::size_t in = 0; in < grid.size(); ++in)
        for (std::size_t to = in + 1; to < grid.size(); ++to)
            out.emplace_back(grid[in], grid[to]);
    return out;
}

/// A light as a function of wavelength: whole nanometres joined by straight lines.
double power(const Illuminant& light, double nm) {
    const auto whole = [&](int at) {
        const int i = at - kUltravioletFirstNm;
        if (i < 0 || at > kObserverLastNm)
            return 0.0;
        return at < kObserverFirstNm ? light.ultraviolet[static_cast<std::size_t>(i)]
                                     : light.power[static_cast<std::size_t>(at - kObserverFirstNm)];
    };
    const int below = static_cast<int>(std::floor(nm));
    const double t = nm - below;
    return t == 0 ? whole(below) : (1 - t) * whole(below) + t * whole(below + 1);
}

/// What a band at `at` among `grid` stands for: 1 at its wavelength and 0 at its neighbours', or its bin.
double phi(const std::vector<double>& grid, std::size_t at, bool bins, double nm) {
    const double here = grid[at];
    const double below = at > 0 ? grid[at - 1] : 2 * here - grid[at + 1];
    const double above = at + 1 < grid.size() ? grid[at + 1] : 2 * here - grid[at - 1];
    if (bins)
        return nm >= (below + here) / 2 && nm <= (here + above) / 2 ? 1 : 0;
    return std::max(0.0, nm < here ? (nm - below) / (here - below) : (above - nm) / (above - here));
}

/// The mean of the light over a band, by Gauss's rule between all places where anything bends.
double mean_light(const Illuminant& light, const std::vector<double>& grid, std::size_t at, bool bins) {
    if (grid[at] < light.first_nm || grid[at] > light.last_nm)
        return 0;
    std::vector<double> knots{light.first_nm, light.last_nm, grid[at]};
    for (const double neighbour : {at > 0 ? grid[at - 1] : 2 * grid[at] - grid[at + 1],
                                   at + 1 < grid.size() ? grid[at + 1] : 2 * grid[at] - grid[at - 1]})
        knots.push_back(bins ? (neighbour + grid[at]) / 2 : neighbour);
    for (int nm = kUltravioletFirstNm; nm <= kObserverLastNm; ++nm)
        knots.push_back(nm);
    std::sort(knots.begin(), knots.end());
    double sum = 0, width = 0;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        const double middle = (knots[k] + knots[k + 1]) / 2, half = (knots[k + 1] - knots[k]) / 2;
        if (half == 0 || middle < light.first_nm || middle > light.last_nm)
            continue;
        for (const double side : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
            const double nm = middle + side * half, share = phi(grid, at, bins, nm);
            sum += half * share * power(light, nm);
            width += half * share;
        }
    }
    return sum / width;
}

/// X, Y, Z of what the pairs send out, Y = 1 for the diffuser: spectral radiance at 1 nm, then CIE 15's sum.
Vector3 emitted_xyz(const std::vector<Pair>& pairs, const std::vector<double>& samples,
                    const Illuminant& light, bool bins) {
    const Observer observer = find_observer("cie1931").value();
    std::vector<double> in, out;
    for (const auto& [a, b] : pairs) {
        in.push_back(a);
        out.push_back(b);
    }
    for (auto* axis : {&in, &out}) {
        std::sort(axis->begin(), axis->end());
        axis->erase(std::unique(axis->begin(), axis->end()), axis->end());
    }
    std::vector<double> radiance(out.size(), 0.0);  // the Donaldson matrix times the light
    for (std::size_t to = 0; to < out.size(); ++to)
        for (std::size_t from = 0; from < in.size(); ++from) {
            double sum = 0, count = 0;
            for (std::size_t i = 0; i < pairs.size(); ++i)
                if (pairs[i] == Pair(in[from], out[to])) {
                    sum += samples[i];
                    count += 1;
                }
            if (count > 0)
                radiance[to] += sum / count * mean_light(light, in, from, bins);
        }
    Vector3 xyz{};
    double white = 0;
    constexpr int kFine = 64;  // of bins, whose sum at 1 nm is an integral over each bin
    for (std::size_t i = 0; i < kObserverSampleCount; ++i) {
        const double nm = kObserverFirstNm + static_cast<double>(i);
        white += light.power[i] * observer.curves[1][i];
        double spectrum = 0;
        for (std::size_t to = 0; to < out.size() && !bins; ++to)
            spectrum += radiance[to] * phi(out, to, false, nm);
        for (std::size_t c = 0; c < 3; ++c)
            xyz[c] += spectrum * observer.curves[c][i];
    }
    for (std::size_t to = 0; to < out.size() && bins; ++to)
        // From 359.5 to 830.5 nm; beyond its ends a curve keeps its end values (bin_basis.h).
        for (int step = -kFine / 2; step < kFine * (kObserverLastNm - kObserverFirstNm) + kFine / 2; ++step) {
            const double place = (step + 0.5) / kFine;
            const double inside = std::clamp(place, 0.0, static_cast<double>(kObserverSampleCount - 1));
            const auto i = std::min(static_cast<std::size_t>(inside), kObserverSampleCount - 2);
            const double t = inside - static_cast<double>(i);
            const double here = phi(out, to, true, kObserverFirstNm + place);
            for (std::size_t c = 0; c < 3; ++c) {
                const NmSamples& curve = observer.curves[c];
                xyz[c] += here * radiance[to] * ((1 - t) * curve[i] + t * curve[i + 1]) / kFine;
            }
        }
    for (double& value : xyz)
        value /= white;
    return xyz;
}

/// What the pairs add to a plan's outputs.
std::vector<double> added(const CollapsePlan& plan, const std::vector<double>& samples) {
    std::vector<double> out;
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        double sum = 0;
        for (std::size_t i = 0; i < samples.size(); ++i)
            sum += plan.weights.at(row, plan.bands.size() + i) * samples[i];
        out.push_back(sum);
    }
    return out;
}

std::vector<double> random_samples(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> value(0, 0.05);
    std::vector<double> out(count);
    std::generate(out.begin(), out.end(), [&] { return value(random); });
    return out;
}

TEST(Reradiation, IsTheDonaldsonMatrixTimesTheLight) {
    std::mt19937 random(11);
    Bound bound("pairs against the matrix, of Y = 1", 1e-13);
    // Edges of bins that lie on the fine steps of the evaluation: its midpoint rule is then exact.
    const std::vector<std::vector<double>> grids{steps(300, 10, 780),
                                                 steps(380, 20, 780),
                                                 steps(290, 5, 520),
                                                 {310, 330, 346, 400, 480, 500, 612, 700}};
    for (const auto& grid : grids)
        for (const std::string light : {"D65", "A", "FL11", "E", "B", "D(5200)", "blackbody(4000)", "HPS"})
            for (const std::string basis : {"linear", "bins"}) {
                const auto bands = steps(380, 10, 780);
                const auto pairs = triangle(grid);
                const auto samples = random_samples(random, pairs.size());
                const auto plan =
                    plan_of(fluorescent(bands, pairs), "to=xyz&illuminant=" + light + "&basis=" + basis)
                        .value();
                const auto found = added(plan, samples);
                const Vector3 expected =
                    emitted_xyz(pairs, samples, find_illuminant(light).value(), basis == "bins");
                for (std::size_t c = 0; c < 3; ++c)
                    bound.see_absolute(found[c], expected[c], light + " " + basis);
            }
}

TEST(Reradiation, FlatEmissionAddsItsSumToAFlatReflectance) {
    // Every exciting band of 10 sends out 2 % of the light at every visible wavelength: 0.5 + 10 x 0.02.
    std::vector<Pair> pairs;
    for (const double in : steps(310, 10, 400))
        for (const double out : steps(350, 5, 840))
            pairs.emplace_back(in, out);
    for (const char* to : {"luminance", "lin_rec709", "acescg", "xyz"})
        for (const char* basis : {"linear", "bins", "sprague", "e2022"}) {
            const auto set = fluorescent(steps(380, 5, 780), pairs);
            const auto plan = plan_of(set, std::string("to=") + to + "&illuminant=E&basis=" + basis).value();
            std::vector<double> samples(set.bands.size(), 0.5);
            samples.resize(set.bands.size() + pairs.size(), 0.02);
            const auto out = outputs_of(plan, samples);
            const std::size_t y = out.size() == 1 ? 0 : 1;
            EXPECT_NEAR(out[y], 0.7, 1e-9) << to << " " << basis;
        }
}

TEST(Reradiation, LeavesTheBandsWeightsAsTheyAre) {
    const auto grid = steps(380, 10, 780);
    for (const char* to : {"to=xyz", "to=srgb", "to=lab", "to=luminance"}) {
        const std::string request = std::string(to) + "&illuminant=FL2&exposure=1";
        const auto plain = plan_of(set_of(Family::T, grid), request).value();
        const auto with = plan_of(fluorescent(grid, triangle(grid)), request).value();
        EXPECT_EQ(plain.columns.size(), grid.size());
        EXPECT_FALSE(plain.reradiation);
        EXPECT_EQ(with.columns.size(), grid.size() + grid.size() * (grid.size() - 1) / 2);
        EXPECT_NE(plain.id, with.id);
        for (std::size_t row = 0; row < plain.weights.rows(); ++row)
            for (std::size_t band = 0; band < grid.size(); ++band)
                EXPECT_EQ(plain.weights.at(row, band), with.weights.at(row, band));
    }
}

TEST(Reradiation, FollowsScaleExposureAndFilters) {
    const auto set = fluorescent(steps(380, 10, 780), triangle(steps(300, 20, 700)));
    const auto weights = [&](const std::string& more, const TextLoader& load) {
        return make_plan(set, request_of("to=xyz&illuminant=D65" + more), load).value().weights;
    };
    const TextLoader grey = [](std::string_view) { return std::string("nm,t\n250,0.25\n850,0.25\n"); };
    // Nothing below 400 nm, all from 400.001 nm on.
    const TextLoader longpass = [](std::string_view) {
        return std::string("nm,t\n250,0\n400,0\n400.001,1\n850,1\n");
    };
    const auto plain = weights("", no_files), twice = weights("&exposure=1", no_files);
    const auto dim = weights("&filter=g.csv", grey), cut = weights("&filter=g.csv", longpass);
    const auto balanced = weights("&filter=g.csv&filter-normalise=1", grey);
    std::size_t ultraviolet = 0;
    for (std::size_t pair = 0; pair < set.reradiation.size(); ++pair) {
        const std::size_t column = set.bands.size() + pair;
        for (std::size_t row = 0; row < 3; ++row) {
            const double weight = plain.at(row, column);
            EXPECT_EQ(twice.at(row, column), 2 * weight);
            EXPECT_NEAR(dim.at(row, column), weight / 4, 1e-15);
            EXPECT_NEAR(balanced.at(row, column), weight, 1e-15);
            if (set.reradiation[pair].excited_nm <= 380) {
                EXPECT_EQ(cut.at(row, column), 0);
                ++ultraviolet;
            }
            if (set.reradiation[pair].excited_nm >= 440) {
                EXPECT_NEAR(cut.at(row, column), weight, 1e-15);
            }
        }
    }
    EXPECT_GT(ultraviolet, 0U);
}

TEST(Reradiation, ALightWithoutUltravioletExcitesNothingThereAndSaysSo) {
    const auto set = fluorescent(steps(400, 10, 700), {{320, 450}, {340, 450}, {420, 520}, {440, 520}});
    const auto plan = plan_of(set, "to=xyz&illuminant=FL11").value();
    for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_EQ(plan.weights.at(row, set.bands.size()), 0);
        EXPECT_EQ(plan.weights.at(row, set.bands.size() + 1), 0);
        EXPECT_GT(plan.weights.at(row, set.bands.size() + 2), 0);
    }
    EXPECT_FALSE(plan.weights.needs(set.bands.size()));
    EXPECT_GT(plan.reradiation->unlit_share, 0);
    const auto said = [](const CollapsePlan& made) {
        return std::count_if(made.warnings.begin(), made.warnings.end(), [](const std::string& warning) {
            return warning.find("no light is assumed at 2 of 4 exciting bands (320-340 nm)") !=
                   std::string::npos;
        });
    };
    EXPECT_EQ(said(plan), 1) << plan.warnings.back();
    const auto lit = plan_of(set, "to=xyz&illuminant=D65").value();
    EXPECT_EQ(said(lit), 0);
    EXPECT_EQ(lit.reradiation->unlit_share, 0);
    EXPECT_GT(lit.weights.at(1, set.bands.size()), 0);
}

TEST(Reradiation, AFilterWithoutUltravioletSaysSo) {
    const auto set = fluorescent(steps(400, 10, 700), {{320, 450}, {340, 460}});
    const TextLoader load = [](std::string_view) { return std::string("nm,t\n380,0.5\n780,0.5\n"); };
    const auto plan = make_plan(set, request_of("to=xyz&illuminant=D65&filter=g.csv"), load).value();
    EXPECT_TRUE(std::any_of(plan.warnings.begin(), plan.warnings.end(), [](const std::string& warning) {
        return warning.find("filter g.csv is known from 380 to 780 nm") != std::string::npos;
    }));
}

TEST(Reradiation, PairsOfTheSameWavelengthsShareTheirWeight) {
    const auto bands = steps(400, 10, 700);
    const std::vector<std::string> twice{"T.0,4um.500nm", "T.400nm.500nm", "T.420nm.500nm", "T.410nm.510nm"};
    std::vector<std::string> names{"T.400nm", "T.500nm"};
    names.insert(names.end(), twice.begin(), twice.end());
    const auto layout = parse_channel_layout(names, DecimalMark::Comma);
    ASSERT_EQ(layout.warnings.size(), 1U);
    EXPECT_NE(layout.warnings[0].find("\"T.400nm.500nm\" is a pair of wavelengths that another channel has"),
              std::string::npos);
    const auto both = plan_of(layout.sets.at(0), "to=xyz&illuminant=D65").value();
    names.erase(names.begin() + 2);
    const auto one =
        plan_of(parse_channel_layout(names, DecimalMark::Comma).sets.at(0), "to=xyz&illuminant=D65").value();
    EXPECT_EQ(both.weights.at(1, 2), both.weights.at(1, 3));
    EXPECT_EQ(2 * both.weights.at(1, 2), one.weights.at(1, 2));
    EXPECT_EQ(both.weights.at(1, 5), one.weights.at(1, 4));
}

TEST(Reradiation, TowardsShorterWavesIsTakenAtItsWordWithAWarning) {
    const std::vector<std::string> names{"T.400nm", "T.500nm", "T.500nm.400nm", "T.400nm.400nm"};
    const auto layout = parse_channel_layout(names, DecimalMark::Comma);
    ASSERT_EQ(layout.warnings.size(), 1U);
    EXPECT_NE(layout.warnings[0].find("leave at no longer wavelength"), std::string::npos);
    const auto plan = plan_of(layout.sets.at(0), "to=xyz&illuminant=D65").value();
    EXPECT_GT(plan.weights.at(2, 2), 0);
    EXPECT_GT(plan.weights.at(2, 3), 0);
}

TEST(Reradiation, OneExcitingBandTakesTheWidthOfTheOthers) {
    // A lamp at 365 nm: 365 +- 10 nm, because the emission is sampled at 10 nm.
    std::vector<Pair> pairs;
    for (const double out : steps(420, 10, 600))
        pairs.emplace_back(365, out);
    const auto plan = plan_of(fluorescent({450, 550}, pairs), "to=xyz&illuminant=E").value();
    std::vector<double> samples(pairs.size(), 0.01);
    const auto found = added(plan, samples);
    // Light E is 100 at any width; the emission is 1 % of it over 420-600 nm.
    const Observer observer = find_observer("cie1931").value();
    double y = 0, white = 0;
    for (std::size_t i = 0; i < kObserverSampleCount; ++i) {
        const double nm = kObserverFirstNm + static_cast<double>(i);
        white += observer.curves[1][i];
        y += observer.curves[1][i] * std::clamp(std::min(nm - 410, 610 - nm) / 10, 0.0, 1.0);
    }
    EXPECT_NEAR(found[1], 0.01 * y / white, 1e-15);
    const auto refused = plan_of(fluorescent({450}, {{365, 450}}), "to=xyz&illuminant=E");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find("how wide"), std::string::npos);
}

TEST(Reradiation, AUserTableGivesItsUltraviolet) {
    const auto set = fluorescent(steps(400, 10, 700), {{300, 450}, {310, 460}});
    const TextLoader load = [](std::string_view) { return std::string("nm,p\n250,7\n830,7\n"); };
    const auto mine = make_plan(set, request_of("to=xyz&illuminant=flat.csv"), load).value();
    const auto theirs = plan_of(set, "to=xyz&illuminant=E").value();
    for (std::size_t column = 0; column < mine.columns.size(); ++column)
        EXPECT_NEAR(mine.weights.at(1, column), theirs.weights.at(1, column), 1e-16);
}

TEST(Reradiation, TheUltravioletOfTablesJoinsTheirVisiblePart) {
    for (const std::string& name : illuminant_names()) {
        const Illuminant light = find_illuminant(name).value();
        const double before = light.ultraviolet.back(), after = light.power.front();
        if (light.first_nm > 359) {
            EXPECT_EQ(before, 0) << name;
            continue;
        }
        EXPECT_LE(std::abs(after - before), 0.05 * after + 0.3) << name;
    }
    // Nominal daylight by its formula: the tables are rounded to three decimals at worst.
    const UltravioletSamples d65 = daylight_ultraviolet(6500 * 1.4388 / 1.438).value();
    for (std::size_t i = 100; i < d65.size(); ++i)
        EXPECT_NEAR(find_illuminant("D65")->ultraviolet[i], d65[i], 0.02) << 200 + i;
    const UltravioletSamples thermal = blackbody_ultraviolet(2856);
    const Illuminant a = find_illuminant("A").value();
    const double scale = a.power[200] / blackbody_power(2856)[200];
    for (std::size_t i = 100; i < thermal.size(); ++i)
        EXPECT_NEAR(a.ultraviolet[i] / (scale * thermal[i]), 1, 0.002) << 200 + i;
}

TEST(Reradiation, NinetyBandsWithAllTheirPairsAreExecuted) {
    const auto grid = steps(335, 5, 780);
    const auto set = fluorescent(grid, triangle(grid));
    const auto plan = plan_of(set, "to=lin_rec709&illuminant=D65").value();
    ASSERT_EQ(plan.columns.size(), 4095U);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> value(0, 0.01F);
    std::vector<float> samples(plan.columns.size());
    std::generate(samples.begin(), samples.end(), [&] { return value(random); });
    const auto expected = outputs_of(plan, std::vector<double>(samples.begin(), samples.end()));
    const auto found = executed(plan, samples);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(found[c]), expected[c], 1e-7 * std::abs(expected[c]));
}

}  // namespace
}  // namespace osio::test
