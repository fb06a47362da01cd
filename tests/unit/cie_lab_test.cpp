// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/pixel_stage.h>
#include <osio/colour/cie_lab.h>

#include <support/bound.h>
#include <support/sets.h>

#include <limits>
#include <random>

namespace osio::test {
namespace {

const Vector3 kWhite = kD65.xyz();

Vector3 random_xyz(std::mt19937& random, double low, double high) {
    std::uniform_real_distribution<double> value(low, high);
    return {value(random), value(random), value(random)};
}

TEST(CieLab, WhiteIsAHundredAndNeutral) {
    const Lab lab = lab_of(kWhite, kWhite);
    EXPECT_EQ(lab.l, 100);
    EXPECT_EQ(lab.a, 0);
    EXPECT_EQ(lab.b, 0);
    const Luv luv = luv_of(kWhite, kWhite);
    EXPECT_EQ(luv.l, 100);
    EXPECT_EQ(luv.u, 0);
    EXPECT_EQ(luv.v, 0);
}

TEST(CieLab, BlackIsNeutralAndHasTheWhitesChromaticity) {
    const Vector3 black{};
    EXPECT_NEAR(lab_of(black, kWhite).l, 0, 1e-14);
    EXPECT_EQ(lab_of(black, kWhite).a, 0);
    EXPECT_EQ(lab_of(black, kWhite).b, 0);
    EXPECT_EQ(luv_of(black, kWhite).u, 0);
    EXPECT_NEAR(xy_of(black, kWhite).x, 0.3127, 1e-15);
    EXPECT_NEAR(xy_of(black, kWhite).y, 0.3290, 1e-15);
    EXPECT_EQ(uv_of(black, kWhite).u, uv_of(kWhite, kWhite).u);
}

TEST(CieLab, TheBranchesMeetAndTheLineGoesOnBelowZero) {
    const double join = 216.0 / 24389.0;
    const auto l = [](double y) { return lab_of({y, y, y}, {1, 1, 1}).l; };
    EXPECT_NEAR(l(join), 8, 1e-13);
    EXPECT_NEAR(l(std::nextafter(join, 1)), 8, 1e-13);
    const double slope = 24389.0 / 27.0;  // CIE 15's 903.3, exact
    for (const double y : {-1.0, -0.01, -1e-300, 0.0, 1e-44, 0.001, 0.008})
        EXPECT_NEAR(l(y), slope * y, 1e-12 * std::max(1.0, std::abs(slope * y))) << y;
}

TEST(CieLab, LabReadsBack) {
    std::mt19937 random(1);
    Bound bound("XYZ of Lab of XYZ", 2e-14);
    for (int i = 0; i < 2000; ++i) {
        const Vector3 xyz = random_xyz(random, -0.3, 1.5);
        const Vector3 back = xyz_of(lab_of(xyz, kWhite), kWhite);
        for (std::size_t c = 0; c < 3; ++c)
            bound.see_absolute(back[c], xyz[c], std::to_string(i));
    }
}

TEST(CieLab, ChromaticitiesDoNotDependOnTheScale) {
    std::mt19937 random(2);
    Bound bound("chromaticity under scale", 1e-15);
    for (int i = 0; i < 500; ++i) {
        const Vector3 xyz = random_xyz(random, 0.01, 1);
        for (const double scale : {1e-300, 1e-40, 3.0, 1e30}) {
            const Vector3 scaled{scale * xyz[0], scale * xyz[1], scale * xyz[2]};
            bound.see_absolute(xy_of(scaled, kWhite).x, xy_of(xyz, kWhite).x, "x");
            bound.see_absolute(uv_of(scaled, kWhite).v, uv_of(xyz, kWhite).v, "v'");
        }
    }
}

TEST(CieLab, UniformChromaticityIsTheProjectionOfXy) {
    // CIE 15:2018, 8.3: u' = 4x / (-2x + 12y + 3), v' = 9y / (-2x + 12y + 3).
    std::mt19937 random(3);
    Bound bound("u'v' by way of xy", 2e-15);
    for (int i = 0; i < 500; ++i) {
        const Vector3 xyz = random_xyz(random, 0.01, 1);
        const Chromaticity xy = xy_of(xyz, kWhite);
        const double below = -2 * xy.x + 12 * xy.y + 3;
        bound.see_absolute(uv_of(xyz, kWhite).u, 4 * xy.x / below, "u'");
        bound.see_absolute(uv_of(xyz, kWhite).v, 9 * xy.y / below, "v'");
    }
}

TEST(CieLab, NothingFiniteGivesNan) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, 1e-44, -1e-44, 1e38, -1e38, 15.0})
        for (const double y : {0.0, 1.0, -1.0, 1e-44, 1e38})
            for (const double z : {0.0, 1.0, -1.0, -1e38}) {
                const Vector3 xyz{x, y, z};
                const Lab lab = lab_of(xyz, kWhite);
                const Luv luv = luv_of(xyz, kWhite);
                const Lch lch = lch_of(lab);
                const Chromaticity xy = xy_of(xyz, kWhite);
                const UniformChromaticity uv = uv_of(xyz, kWhite);
                for (const double out :
                     {lab.l, lab.a, lab.b, luv.l, luv.u, luv.v, lch.c, lch.h_deg, xy.x, xy.y, uv.u, uv.v})
                    EXPECT_FALSE(std::isnan(out)) << x << " " << y << " " << z;
                EXPECT_GE(lch.h_deg, 0);
                EXPECT_LE(lch.h_deg, 360);
            }
}

TEST(CieLab, APlansWhiteIsTheLightsOwn) {
    for (const char* light : {"A", "FL11", "D65"}) {
        const auto plan =
            plan_of(set_of(Family::T, steps(380, 5, 780)), std::string("to=lab&illuminant=") + light).value();
        const auto xyz = outputs_of(plan, std::vector<double>(81, 1.0));
        const Vector3 lab = PixelStage(plan.space, plan.white).convert({xyz[0], xyz[1], xyz[2]});
        EXPECT_NEAR(lab[0], 100, 1e-11) << light;
        EXPECT_NEAR(lab[1], 0, 1e-11) << light;
        EXPECT_NEAR(lab[2], 0, 1e-11) << light;
        EXPECT_EQ(plan.channel_names(), (std::vector<std::string>{"L*", "a*", "b*"}));
    }
}

TEST(PixelStage, EveryPixelIsItsConversionWithAlphaTakenOut) {
    std::mt19937 random(4);
    for (const char* name : {"lab", "luv", "xyY", "uv", "srgb", "acescg"}) {
        const OutputSpace space = find_output_space(name).value();
        const PixelStage stage(space, kWhite);
        EXPECT_EQ(stage.needed(), space.id != "acescg");
        const std::vector<float> alpha{1.0F, 0.5F, 0.25F, 0.0F, -1.0F};
        std::vector<std::vector<float>> planes(3, std::vector<float>(alpha.size()));
        for (auto& plane : planes)
            for (float& value : plane)
                value = static_cast<float>(random_xyz(random, 0, 1)[0]);
        const auto before = planes;
        const std::array<float*, 3> pointers{planes[0].data(), planes[1].data(), planes[2].data()};
        stage.apply(pointers, alpha.data(), alpha.size());
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            const double share = alpha[i] > 0 ? static_cast<double>(alpha[i]) : 1;
            Vector3 linear{};
            for (std::size_t c = 0; c < 3; ++c)
                linear[c] = static_cast<double>(before[c][i]) / share;
            const Vector3 expected = stage.convert(linear);
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_EQ(planes[c][i], static_cast<float>(expected[c] * share)) << name << i;
        }
    }
}

TEST(PixelStage, SrgbReadsBack) {
    Bound bound("sRGB there and back", 1e-14);
    for (double linear = -0.5; linear < 4; linear += 0.0007)
        bound.see_absolute(srgb_decode(srgb_encode(linear)), linear, std::to_string(linear));
}

}  // namespace
}  // namespace osio::test
