// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/adaptation.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/rgb_space.h>

#include <support/bound.h>
#include <support/csv.h>

namespace osio::test {
namespace {

Matrix3 matrix_of(const Csv::Row& row) {
    Matrix3 m;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            m.rows[r][c] = number(row, "m" + std::to_string(r) + std::to_string(c));
    return m;
}

void see_matrix(Bound& bound, const Matrix3& actual, const Matrix3& expected, const std::string& where) {
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            bound.see_absolute(actual.rows[r][c], expected.rows[r][c],
                               where + " " + std::to_string(r) + std::to_string(c));
}

TEST(GoldenColour, WhitePointsAreTheSumsAtOneNanometre) {
    Bound bound("G6 absolute xy error of white points", 1e-12);
    for (const auto& row : Csv(golden("whitepoints.csv")).rows) {
        const auto light = find_illuminant(row.at("illuminant"));
        ASSERT_TRUE(light) << light.error().text();
        const auto observer = find_observer(row.at("observer") == "2" ? "cie1931" : "cie1964");
        const Vector3 white = white_point(*light, *observer).value();
        const double sum = white[0] + white[1] + white[2];
        const std::string where = row.at("illuminant") + " " + row.at("observer");
        bound.see_absolute(white[0] / sum, number(row, "x_1nm_360_830"), where + " x");
        bound.see_absolute(white[1] / sum, number(row, "y_1nm_360_830"), where + " y");
    }
}

TEST(GoldenColour, WhitePointsAgreeWithThePublishedOnes) {
    Bound bound("G6 absolute xy distance to the published white points", 3e-4);
    for (const auto& row : Csv(golden("whitepoints.csv")).rows) {
        if (!parse_double(row.at("x_published_rounded")))
            continue;
        const Vector3 white =
            white_point(find_illuminant(row.at("illuminant")).value(),
                        find_observer(row.at("observer") == "2" ? "cie1931" : "cie1964").value())
                .value();
        const double sum = white[0] + white[1] + white[2];
        bound.see_absolute(white[0] / sum, number(row, "x_published_rounded"), row.at("illuminant"));
        bound.see_absolute(white[1] / sum, number(row, "y_published_rounded"), row.at("illuminant"));
    }
}

TEST(GoldenColour, PrimaryMatricesAreExact) {
    const std::map<std::string, std::string> ids{{"sRGB", "lin_rec709"},
                                                 {"Rec2020", "lin_rec2020"},
                                                 {"ACES2065-1", "aces2065_1"},
                                                 {"ACEScg", "acescg"}};
    Bound bound("G7 absolute error of RGB matrices against exact rationals", 4e-15);
    for (const auto& row : Csv(golden("rgb_matrices.csv")).rows) {
        if (row.at("variant") != "exact_from_xy" || !ids.contains(row.at("space")))
            continue;
        const Matrix3 xyz_from_rgb_matrix = xyz_from_rgb(find_output_space(ids.at(row.at("space"))).value());
        const bool inverted = row.at("direction") == "XYZ_to_RGB";
        see_matrix(bound, inverted ? inverse(xyz_from_rgb_matrix) : xyz_from_rgb_matrix, matrix_of(row),
                   row.at("space") + " " + row.at("direction"));
    }
}

TEST(GoldenColour, AdaptationMatricesAreExact) {
    std::map<std::string, Vector3> whites;
    for (const auto& row : Csv(golden("white_constants.csv")).rows)
        whites[row.at("white")] = {number(row, "X"), number(row, "Y"), number(row, "Z")};
    Bound bound("G7 absolute error of adaptation matrices against exact rationals", 4e-15);
    for (const auto& row : Csv(golden("cat_matrices.csv")).rows)
        see_matrix(bound,
                   adaptation_matrix(find_adaptation(row.at("cat")).value(), whites.at(row.at("from_white")),
                                     whites.at(row.at("to_white")))
                       .value(),
                   matrix_of(row), row.at("cat") + " " + row.at("from_white") + " to " + row.at("to_white"));
}

TEST(GoldenColour, NominalWhitesAreTheStandards) {
    Bound bound("absolute error of white constants", 1e-15);
    for (const auto& row : Csv(golden("white_constants.csv")).rows) {
        const std::map<std::string, Chromaticity> known{{"D65", kD65}, {"D50", kD50}, {"ACES", kAcesWhite}};
        if (!known.contains(row.at("white")))
            continue;
        const Vector3 white = known.at(row.at("white")).xyz();
        bound.see_absolute(white[0], number(row, "X"), row.at("white"));
        bound.see_absolute(white[2], number(row, "Z"), row.at("white"));
    }
}

}  // namespace
}  // namespace osio::test
