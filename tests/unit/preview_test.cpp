// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/preview.h>
#include <osio/colour/rgb_space.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace osio {
namespace {

std::vector<PreviewSample> picture(const Matrix3& recipe, int count, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    std::vector<PreviewSample> out;
    for (int i = 0; i < count; ++i) {
        const Vector3 xyz{value(random), value(random), value(random)};
        out.push_back({xyz, recipe * xyz});
    }
    return out;
}

const Matrix3 kRecipe{{{{2.1, -0.9, -0.3}, {-0.5, 1.6, 0.1}, {0.05, -0.2, 1.4}}}};

TEST(Preview, AnyRecipeOfThreeByThreeIsRecovered) {
    const Matrix3 fit = fit_preview(picture(kRecipe, 500));
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(fit.rows[r][c], kRecipe.rows[r][c], 1e-3);
    EXPECT_LT(preview_distance(picture(kRecipe, 500), fit).rms, 1e-4);
}

TEST(Preview, OnePixelIsExplainedByAMultipleOfSrgb) {
    const Matrix3 srgb = inverse(xyz_from_rgb(find_output_space("lin_rec709").value()));
    std::vector<PreviewSample> one{{{0.95, 1, 1.09}, srgb * Vector3{9.5, 10, 10.9}}};
    const Matrix3 fit = fit_preview(one);
    EXPECT_LT(preview_distance(one, fit).rms, 1e-4);  // the ridge leaves a little
    EXPECT_NEAR(fit.rows[0][0], 10 * srgb.rows[0][0], 0.1);
}

TEST(Preview, WhatTreatsAllChannelsAlikeKeepsTheRelation) {
    const auto source = picture(kRecipe, 1000);
    EXPECT_TRUE(preview_matches(source, source));
    auto brighter = source;
    for (auto& s : brighter)
        for (std::size_t c = 0; c < 3; ++c) {
            s.xyz[c] *= 3;
            s.rgb[c] *= 3;
        }
    EXPECT_TRUE(preview_matches(source, brighter));
    EXPECT_TRUE(preview_matches(source, picture(kRecipe, 300, 2)));  // another crop
}

TEST(Preview, EditsOfOneSideBreakIt) {
    const auto source = picture(kRecipe, 1000);
    auto bands_halved = source, picture_halved = source, graded = source, painted = source;
    for (auto& s : bands_halved)
        for (double& x : s.xyz)
            x *= 0.5;
    for (auto& s : picture_halved)
        for (double& x : s.rgb)
            x *= 0.5;
    for (auto& s : graded)
        for (double& x : s.rgb)
            x = std::sqrt(std::abs(x));
    for (std::size_t i = 0; i < 10; ++i)
        painted[i].xyz = {0, 0, 0};
    EXPECT_FALSE(preview_matches(source, bands_halved));
    EXPECT_FALSE(preview_matches(source, picture_halved));
    EXPECT_FALSE(preview_matches(source, graded));
    EXPECT_FALSE(preview_matches(source, painted));
}

TEST(Preview, WithoutASourceAnyPlausiblePictureStays) {
    EXPECT_TRUE(preview_matches({}, picture(kRecipe, 500)));
    auto unrelated = picture(kRecipe, 500);
    const auto other = picture(kRecipe, 500, 9);
    for (std::size_t i = 0; i < unrelated.size(); ++i)
        unrelated[i].rgb = other[i].rgb;
    EXPECT_FALSE(preview_matches({}, unrelated));
}

TEST(Preview, BlackAndBrokenPixelsDecideNothing) {
    const std::vector<PreviewSample> black(10);
    EXPECT_TRUE(preview_matches({}, black));
    EXPECT_TRUE(preview_matches(black, black));
    auto broken = picture(kRecipe, 100);
    broken[3].xyz[0] = std::numeric_limits<double>::quiet_NaN();
    broken[4].rgb[1] = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(preview_matches(broken, broken));
}

}  // namespace
}  // namespace osio
