// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/cct.h>
#include <osio/colour/illuminant.h>

#include <support/bound.h>
#include <support/csv.h>

namespace osio::test {
namespace {

/// A point at a signed distance from the locus, along its normal in CIE 1960 (u, v).
UniformChromaticity beside_locus(double temperature_k, double duv) {
    const UniformChromaticity at = planckian_chromaticity(temperature_k);
    const UniformChromaticity warmer = planckian_chromaticity(temperature_k * (1 - 1e-5));
    const UniformChromaticity colder = planckian_chromaticity(temperature_k * (1 + 1e-5));
    const double du = warmer.u - colder.u, dv = 2 * (warmer.v - colder.v) / 3;
    const double length = std::hypot(du, dv);
    return {at.u - duv * dv / length, at.v + 1.5 * duv * du / length};
}

TEST(Cct, ThePointsBesideTheLocusAreFoundAgain) {
    Bound temperature("relative error of the temperature", 1e-6);
    Bound distance("error of Duv", 1e-9);
    for (double t = 1100; t < 20000; t *= 1.19)
        for (const double duv : {-0.02, -0.006, 0.0, 0.003, 0.02}) {
            const auto found = colour_temperature(beside_locus(t, duv));
            ASSERT_TRUE(found) << t << " " << duv;
            const std::string where = std::to_string(t) + " " + std::to_string(duv);
            temperature.see_relative(found->cct_k, t, where);
            distance.see_absolute(found->duv, duv, where);
        }
}

TEST(Cct, NoPointOfTheLocusIsNearer) {
    for (const char* light : {"A", "D50", "D65", "FL2", "FL11", "LED-B5", "HP5"}) {
        const Vector3 white =
            white_point(find_illuminant(light).value(), find_observer("cie1931").value()).value();
        const UniformChromaticity uv = uv_of(white, white);
        const auto found = colour_temperature(uv).value();
        for (double mired = 20; mired < 900; mired += 0.37) {
            const UniformChromaticity p = planckian_chromaticity(1e6 / mired);
            EXPECT_GE(std::hypot(uv.u - p.u, 2 * (uv.v - p.v) / 3), std::abs(found.duv) - 1e-12)
                << light << " " << mired;
        }
    }
}

TEST(Cct, TheLocusIsThatOfTheGoldenBlackBodies) {
    Bound bound("xy of black bodies", 1e-12);
    for (const auto& row : Csv(golden("blackbody_xy.csv")).rows) {
        const auto temperature_k = parse_double(row.at("T_K"));
        if (!temperature_k)
            continue;  // the limit of infinite temperature
        const UniformChromaticity uv = planckian_chromaticity(*temperature_k);
        const double x = 9 * uv.u / (6 * uv.u - 16 * uv.v + 12), y = 4 * uv.v / (6 * uv.u - 16 * uv.v + 12);
        bound.see_absolute(x, number(row, "x_2deg"), row.at("T_K"));
        bound.see_absolute(y, number(row, "y_2deg"), row.at("T_K"));
    }
}

TEST(Cct, PublishedTemperaturesOfStandardLights) {
    // CIE 15:2018, tables of illuminants: nominal temperatures on today's scale of c2.
    const auto cct = [](const char* light) {
        const Vector3 white =
            white_point(find_illuminant(light).value(), find_observer("cie1931").value()).value();
        return colour_temperature(uv_of(white, white)).value();
    };
    EXPECT_NEAR(cct("A").cct_k, 2856, 1);
    EXPECT_NEAR(cct("D65").cct_k, 6504, 3);
    EXPECT_NEAR(cct("D65").duv, 0.0032, 1e-4);
    EXPECT_NEAR(cct("D50").cct_k, 5003, 3);
    EXPECT_NEAR(cct("FL2").cct_k, 4230, 10);
}

TEST(Cct, ColoursFarFromTheLocusHaveNone) {
    const UniformChromaticity green{0.05, 0.58}, nothing{std::nan(""), 0.4};
    EXPECT_FALSE(colour_temperature(green));
    EXPECT_FALSE(colour_temperature(nothing));
    EXPECT_FALSE(colour_temperature(planckian_chromaticity(600)));
    EXPECT_FALSE(colour_temperature(beside_locus(4000, 0.06)));
    EXPECT_TRUE(colour_temperature(beside_locus(4000, 0.049)));
}

}  // namespace
}  // namespace osio::test
