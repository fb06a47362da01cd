// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/baked_matrix.h>
#include <osio/colour/matrix_fit.h>
#include <osio/colour/reflectance_set.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace osio::test {
namespace {

std::vector<Vector3> random_colours(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(0, 1);
    std::vector<Vector3> out(count);
    for (Vector3& colour : out)
        colour = {value(random), value(random), value(random)};
    return out;
}

constexpr Matrix3 kMatrix{{{{1.7, -0.3, 0.1}, {0.2, 0.9, -0.4}, {-0.05, 0.3, 0.6}}}};

double error_of(const Matrix3& matrix, const std::vector<Vector3>& from, const std::vector<Vector3>& to) {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::pow((matrix * from[i])[c] - to[i][c], 2);
    return sum;
}

TEST(MatrixFit, AMatrixIsFoundAgain) {
    const auto from = random_colours(40, 1);
    std::vector<Vector3> to;
    for (const Vector3& colour : from)
        to.push_back(kMatrix * colour);
    const Matrix3 found = fit_matrix(from, to).value();
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(found.rows[r][c], kMatrix.rows[r][c], 1e-13);
    EXPECT_LT(differences_of(to, to, {0.95, 1, 1.09}).max, 1e-12);
}

TEST(MatrixFit, NoOtherMatrixIsNearer) {
    const auto from = random_colours(40, 2), to = random_colours(40, 3);
    const Matrix3 found = fit_matrix(from, to).value();
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            for (const double step : {-1e-3, 1e-3}) {
                Matrix3 other = found;
                other.rows[r][c] += step;
                EXPECT_GT(error_of(other, from, to), error_of(found, from, to));
            }
}

TEST(MatrixFit, TheKeptColourIsExactAndTheRestAsNearAsItAllows) {
    const auto from = random_colours(40, 2), to = random_colours(40, 3);
    const std::pair<Vector3, Vector3> kept{{1, 1, 1}, {0.9, 1, 1.1}};
    const Matrix3 found = fit_matrix_keeping(kept, from, to).value();
    for (std::size_t r = 0; r < 3; ++r)
        EXPECT_NEAR((found * kept.first)[r], kept.second[r], 1e-14);
    // Steps that keep the colour: rows of sum zero.
    for (const Vector3& step :
         {Vector3{1e-3, -1e-3, 0}, Vector3{-1e-3, 1e-3, 0}, Vector3{0, 1e-3, -1e-3}, Vector3{0, -1e-3, 1e-3}})
        for (std::size_t r = 0; r < 3; ++r) {
            Matrix3 other = found;
            for (std::size_t c = 0; c < 3; ++c)
                other.rows[r][c] += step[c];
            EXPECT_GT(error_of(other, from, to), error_of(found, from, to));
        }
}

TEST(MatrixFit, WhatLiesInAPlaneIsRefused) {
    auto from = random_colours(40, 4);
    for (Vector3& colour : from)
        colour[2] = 0.3 * colour[0] + 0.5 * colour[1];
    const auto refused = fit_matrix(from, from);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidGrid);
    EXPECT_FALSE(fit_matrix(random_colours(2, 5), random_colours(2, 6)));
    EXPECT_FALSE(fit_matrix({}, {}));
}

TEST(ReflectanceSet, ATableIsReadByItsColumns) {
    for (const char* const csv : {"nm,a,b\n400,0.1,0.2\n700,0.3,0.4\n", "400;0.1;0.2\n700;0.3;0.4\n",
                                  "# measured\n400 0.1  0.2\n700 0.3 0.4\n"}) {
        const auto set = reflectance_set_from_csv(csv, "my.csv");
        ASSERT_TRUE(set) << set.error().text();
        ASSERT_EQ(set->spectra.size(), 2U);
        EXPECT_EQ(set->spectra[1].front(), 0.2);
        EXPECT_EQ(set->spectra[1].back(), 0.4);
    }
    EXPECT_FALSE(reflectance_set_from_csv("", "my.csv"));
    EXPECT_FALSE(reflectance_set_from_csv("400\n700\n", "my.csv"));
    EXPECT_FALSE(reflectance_set_from_csv("400,1\n700,x\n", "my.csv"));
}

TEST(BakedMatrix, EveryKindIsKnownByItsName) {
    for (const MatrixKind kind : {MatrixKind::Adaptation, MatrixKind::Primaries, MatrixKind::Relight,
                                  MatrixKind::Observer, MatrixKind::Camera})
        EXPECT_EQ(find_matrix_kind(matrix_kind_name(kind)).value(), kind);
    EXPECT_FALSE(find_matrix_kind("lut"));
}

}  // namespace
}  // namespace osio::test
