// SPDX-License-Identifier: Apache-2.0
#include <osio/data/tables.h>

#include <support/bound.h>
#include <support/csv.h>
#include <support/sets.h>

namespace osio::test {
namespace {

constexpr const char* kOhta = "reflectances/colorchecker_n_ohta.csv";

std::string observer_of(const Csv::Row& row) {
    return row.at("observer") == "2" ? "cie1931" : "cie1964";
}

/// The table's column for a row: its patch number, counted from 1.
std::string patch_of(const Csv::Row& row) {
    const auto index = static_cast<std::size_t>(number(row, "patch")) - 1;
    return std::string(find_table(kOhta)->columns[index]);
}

std::string label(const Csv::Row& row) {
    return row.at("name") + " " + row.at("illuminant") + " " + observer_of(row);
}

CollapsePlan plan_for(const Csv::Row& row, const std::vector<double>& nm, const std::string& more) {
    return plan_of(set_of(Family::T, nm),
                   "basis=linear&illuminant=" + row.at("illuminant") + "&observer=" + observer_of(row) + more)
        .value();
}

TEST(GoldenWeights, FiveNanometreTableByStraightLinesIsTheSumAtOneNanometre) {
    const Table& ohta = *find_table(kOhta);
    const std::vector<double> nm(ohta.wavelengths_nm.begin(), ohta.wavelengths_nm.end());
    Bound bound("G1 relative XYZ error, sum1nm_linear", 1e-12);
    for (const auto& row : Csv(golden("xyz_colorchecker.csv")).rows) {
        if (row.at("method") != "sum1nm_linear")
            continue;
        const auto xyz = outputs_of(plan_for(row, nm, "&to=xyz"), ohta.column(patch_of(row))->values);
        bound.see_relative(xyz[0] * 100, number(row, "X"), label(row) + " X");
        bound.see_relative(xyz[1] * 100, number(row, "Y"), label(row) + " Y");
        bound.see_relative(xyz[2] * 100, number(row, "Z"), label(row) + " Z");
    }
}

TEST(GoldenWeights, OneNanometreTableIsSummedAsItIs) {
    const Csv sprague(golden("colorchecker_n_ohta_1nm_sprague.csv"));
    Bound bound("G1 relative XYZ error, sum1nm_sprague", 1e-12);
    for (const auto& row : Csv(golden("xyz_colorchecker.csv")).rows) {
        if (row.at("method") != "sum1nm_sprague")
            continue;
        std::vector<double> reflectance;
        for (const auto& line : sprague.rows)
            reflectance.push_back(number(line, patch_of(row)));
        const auto xyz = outputs_of(plan_for(row, steps(360, 1, 830), "&to=xyz"), reflectance);
        bound.see_relative(xyz[0] * 100, number(row, "X"), label(row) + " X");
        bound.see_relative(xyz[1] * 100, number(row, "Y"), label(row) + " Y");
        bound.see_relative(xyz[2] * 100, number(row, "Z"), label(row) + " Z");
    }
}

/// The exact quadrature, which plans use below 1 nm, on curves that the golden file integrated
/// exactly: product of three piecewise-linear functions.
TEST(GoldenWeights, ExactQuadratureIsTheIntegralOfThreeStraightLines) {
    const Table& ohta = *find_table(kOhta);
    Bound bound("relative XYZ error, exact_piecewise_linear", 1e-12);
    for (const auto& row : Csv(golden("xyz_colorchecker.csv")).rows) {
        if (row.at("method") != "exact_piecewise_linear")
            continue;
        const Illuminant light = find_illuminant(row.at("illuminant")).value();
        const Observer observer = find_observer(observer_of(row)).value();
        const auto reflectance = ohta.column(patch_of(row))->values;
        const double k = 100 / integral(light.power, observer.curves[1], Quadrature::Exact);
        const char* const columns[] = {"X", "Y", "Z"};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto weights = linear_basis_integrals(ohta.wavelengths_nm, light.power, observer.curves[c],
                                                        Extrapolation::Hold, Quadrature::Exact);
            double sum = 0;
            for (std::size_t i = 0; i < weights.size(); ++i)
                sum += k * weights[i] * reflectance[i];
            bound.see_relative(sum, number(row, columns[c]), label(row) + " " + columns[c]);
        }
    }
}

TEST(GoldenWeights, RgbIsAdaptedFromTheLightsOwnWhite) {
    const std::map<std::string, std::string> spaces{{"sRGB", "lin_rec709"},
                                                    {"ACEScg", "acescg"},
                                                    {"ACES2065-1", "aces2065_1"},
                                                    {"Rec2020", "lin_rec2020"}};
    const Csv sprague(golden("colorchecker_n_ohta_1nm_sprague.csv"));
    Bound bound("absolute RGB error, Bradford", 1e-12);
    for (const auto& row : Csv(golden("rgb_colorchecker.csv")).rows) {
        if (row.at("cat_from_illuminant_1nm_white") != "Bradford")
            continue;
        std::vector<double> reflectance;
        for (const auto& line : sprague.rows)
            reflectance.push_back(number(line, patch_of(row)));
        const auto plan = plan_of(set_of(Family::T, steps(360, 1, 830)),
                                  "illuminant=" + row.at("illuminant") + "&to=" + spaces.at(row.at("space")));
        const auto rgb = outputs_of(plan.value(), reflectance);
        const std::string where = row.at("space") + " " + row.at("illuminant") + " patch " + row.at("patch");
        bound.see_absolute(rgb[0], number(row, "R"), where + " R");
        bound.see_absolute(rgb[1], number(row, "G"), where + " G");
        bound.see_absolute(rgb[2], number(row, "B"), where + " B");
    }
}

std::vector<double> number_list(const std::string& text) {
    std::vector<double> out;
    for (const auto piece : split(text, ';')) {
        const auto value = parse_double(piece);
        out.push_back(value ? *value : std::nan(""));
    }
    return out;
}

/// Radiance of degenerate spectra. Rows that a plan refuses, and rows whose values are not finite,
/// have tests of their own.
TEST(GoldenWeights, DegenerateRadianceSpectra) {
    Bound bound("G15 relative XYZ error, extremes", 1e-12);
    for (const auto& row : Csv(golden("extremes.csv")).rows) {
        const std::string name = row.at("case");
        std::vector<double> nm, values;
        if (name == "5000_bands") {
            for (int i = 0; i < 5000; ++i)
                nm.push_back(380 + 400.0 * i / 4999);
            for (const double l : nm)
                values.push_back(0.5 + 0.4 * std::sin(l / 17));
        } else {
            nm = number_list(row.at("wavelengths_nm"));
            values = number_list(row.at("values"));
        }
        const bool finite =
            std::none_of(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
        if (!finite || name == "uv_only" || name == "all_zero")
            continue;
        // The layout has no two channels of one name: equal wavelengths are spelled differently.
        std::vector<std::string> names;
        for (std::size_t i = 0; i < nm.size(); ++i)
            names.push_back("S0." + std::string(i % 3, '0') + format_wavelength(nm[i], DecimalMark::Comma));
        const SpectralSet set = parse_channel_layout(names, DecimalMark::Comma).sets.at(0);
        for (const std::string extrapolate : {"hold", "zero"}) {
            const auto plan = plan_of(set, "to=xyz&basis=linear&extrapolate=" + extrapolate);
            if (name == "one_band_550" && extrapolate == "zero") {
                EXPECT_FALSE(plan);  // a curve of no width: refused
                continue;
            }
            ASSERT_TRUE(plan) << name << ": " << plan.error().text();
            const auto xyz = outputs_of(*plan, values);
            const std::string column = (plan->quadrature == Quadrature::Exact ? "_exact_" : "_sum1nm_") +
                                       std::string(extrapolate == "hold" ? "constext" : "zeroext");
            bound.see_relative(xyz[0], number(row, "X" + column), name + " X" + column);
            bound.see_relative(xyz[1], number(row, "Y" + column), name + " Y" + column);
            bound.see_relative(xyz[2], number(row, "Z" + column), name + " Z" + column);
        }
    }
}

}  // namespace
}  // namespace osio::test
