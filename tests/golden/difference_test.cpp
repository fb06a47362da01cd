// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/difference.h>

#include <support/bound.h>
#include <support/csv.h>

#include <numbers>
#include <random>

namespace osio::test {
namespace {

/// CIEDE2000 once more, from the formulas of ISO/CIE 11664-6 as they are printed, in long double.
long double printed_formula(const Lab& first, const Lab& second) {
    using Real = long double;
    constexpr Real kPi = std::numbers::pi_v<Real>;
    const auto rad = [](Real degrees) { return degrees * kPi / 180; };
    const Real l1 = first.l, a1 = first.a, b1 = first.b, l2 = second.l, a2 = second.a, b2 = second.b;
    const Real mean_c = (std::sqrt(a1 * a1 + b1 * b1) + std::sqrt(a2 * a2 + b2 * b2)) / 2;
    const Real c7 = std::pow(mean_c, Real(7));
    const Real g = (1 - std::sqrt(c7 / (c7 + std::pow(Real(25), Real(7))))) / 2;
    const Real ap1 = (1 + g) * a1, ap2 = (1 + g) * a2;
    const Real cp1 = std::sqrt(ap1 * ap1 + b1 * b1), cp2 = std::sqrt(ap2 * ap2 + b2 * b2);
    const auto hue = [&](Real b, Real a) {
        if (a == 0 && b == 0)
            return Real(0);
        const Real h = std::atan2(b, a) * 180 / kPi;
        return h < 0 ? h + 360 : h;
    };
    const Real hp1 = hue(b1, ap1), hp2 = hue(b2, ap2);
    const bool grey = cp1 == 0 || cp2 == 0;
    const bool near = std::abs(hp1 - hp2) <= 180 + Real(1e-9);
    Real dh = 0;
    if (!grey)
        dh = near ? hp2 - hp1 : hp2 > hp1 ? hp2 - hp1 - 360 : hp2 - hp1 + 360;
    const Real dhp = 2 * std::sqrt(cp1 * cp2) * std::sin(rad(dh / 2));
    const Real lm = (l1 + l2) / 2, cm = (cp1 + cp2) / 2;
    Real hm = hp1 + hp2;
    if (!grey)
        hm = near ? hm / 2 : hm < 360 ? (hm + 360) / 2 : (hm - 360) / 2;
    const Real t = 1 - 0.17L * std::cos(rad(hm - 30)) + 0.24L * std::cos(rad(2 * hm)) +
                   0.32L * std::cos(rad(3 * hm + 6)) - 0.20L * std::cos(rad(4 * hm - 63));
    const Real theta = 30 * std::exp(-((hm - 275) / 25) * ((hm - 275) / 25));
    const Real cm7 = std::pow(cm, Real(7));
    const Real rc = 2 * std::sqrt(cm7 / (cm7 + std::pow(Real(25), Real(7))));
    const Real sl = 1 + 0.015L * (lm - 50) * (lm - 50) / std::sqrt(20 + (lm - 50) * (lm - 50));
    const Real sc = 1 + 0.045L * cm, sh = 1 + 0.015L * cm * t;
    const Real rt = -std::sin(rad(2 * theta)) * rc;
    const Real dl = (l2 - l1) / sl, dc = (cp2 - cp1) / sc, dhs = dhp / sh;
    return std::sqrt(dl * dl + dc * dc + dhs * dhs + rt * dc * dhs);
}

struct Pair {
    Lab a, b;
};

Pair pair_of(const Csv::Row& row) {
    return {{number(row, "L1"), number(row, "a1"), number(row, "b1")},
            {number(row, "L2"), number(row, "a2"), number(row, "b2")}};
}

TEST(Ciede2000, PublishedPairs) {
    Bound published("G8 CIEDE2000 of Sharma's 34 pairs against 4 published decimals", 5e-5);
    Bound exact("G8 CIEDE2000 against 20 digits, without the pair that jumps", 1e-12);
    std::size_t count = 0;
    for (const auto& row : Csv(golden("ciede2000_sharma34.csv")).rows) {
        const Pair pair = pair_of(row);
        for (const double found : {delta_e_2000(pair.a, pair.b), delta_e_2000(pair.b, pair.a)}) {
            published.see_absolute(found, number(row, "dE00_published_4dp"), row.at("pair"));
            if (row.at("pair") != "14")
                exact.see_absolute(found, number(row, "dE00_mpmath_20d"), row.at("pair"));
        }
        ++count;
    }
    EXPECT_EQ(count, 34U);
}

TEST(Ciede2000, RandomPairsAgainstThePrintedFormula) {
    Bound bound("G8 CIEDE2000 against the printed formula in long double", 1e-12);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> l(0, 100), ab(-120, 120), small(-2, 2);
    for (int i = 0; i < 4000; ++i) {
        const Lab a{l(random), ab(random), ab(random)};
        const Lab b = i % 2 == 0 ? Lab{l(random), ab(random), ab(random)}
                                 : Lab{a.l + small(random), a.a + small(random), a.b + small(random)};
        bound.see_absolute(delta_e_2000(a, b), static_cast<double>(printed_formula(a, b)), std::to_string(i));
    }
}

TEST(Ciede2000, IsSymmetricAndZeroForEqualColours) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> l(-10, 120), ab(-150, 150);
    for (int i = 0; i < 2000; ++i) {
        const Lab a{l(random), ab(random), ab(random)}, b{l(random), ab(random), ab(random)};
        EXPECT_NEAR(delta_e_2000(a, b), delta_e_2000(b, a), 1e-12);
        EXPECT_EQ(delta_e_2000(a, a), 0);
        EXPECT_GT(delta_e_2000(a, b), 0);
    }
}

TEST(Ciede2000, GreysDifferByLightnessAlone) {
    EXPECT_NEAR(delta_e_2000({50, 0, 0}, {51, 0, 0}), 1 / (1 + 0.015 * 0.25 / std::sqrt(20.25)), 1e-14);
    EXPECT_TRUE(std::isnan(delta_e_2000({50, std::nan(""), 0}, {51, 0, 0})));
}

}  // namespace
}  // namespace osio::test
