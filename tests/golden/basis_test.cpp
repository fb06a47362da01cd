// SPDX-License-Identifier: Apache-2.0
#include <osio/data/tables.h>
#include <osio/spectra/band_integrals.h>

#include <support/bound.h>
#include <support/csv.h>
#include <support/sets.h>

namespace osio::test {
namespace {

std::string observer_of(const Csv::Row& row) {
    return row.at("observer") == "2" ? "cie1931" : "cie1964";
}

TEST(GoldenBasis, AstmE2022WeightsDigitByDigit) {
    std::map<std::string, std::vector<Csv::Row>> tables;
    for (const auto& row : Csv(golden("astm_e2022_weights_380_780.csv")).rows)
        tables[row.at("illuminant") + " " + row.at("observer") + " " + row.at("step_nm")].push_back(row);
    Bound bound("G2 absolute error of E2022 weights, Y sum = 100", 1e-12);
    for (const auto& [name, rows] : tables) {
        std::vector<double> nm;
        for (const auto& row : rows)
            nm.push_back(number(row, "wavelength_nm"));
        const auto plan =
            plan_of(set_of(Family::T, nm), "to=xyz&basis=e2022&illuminant=" + rows[0].at("illuminant") +
                                               "&observer=" + observer_of(rows[0]))
                .value();
        const char* const columns[] = {"Wx", "Wy", "Wz"};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < nm.size(); ++i)
                bound.see_absolute(100 * plan.weights.at(c, i), number(rows[i], columns[c]),
                                   name + " " + columns[c] + " " + rows[i].at("wavelength_nm"));
    }
}

/// The 1 nm truth sampled at 5, 10 and 20 nm and put together again.
TEST(GoldenBasis, ResampledColorCheckerByEveryInterpolation) {
    const std::map<std::string, std::string> bases{{"linear_to_1nm", "linear"},
                                                   {"sprague_to_1nm", "sprague"}};
    const Csv sprague(golden("colorchecker_n_ohta_1nm_sprague.csv"));
    const Table& ohta = *find_table("reflectances/colorchecker_n_ohta.csv");
    Bound bound("relative XYZ error of resampled reflectances", 1e-12);
    for (const auto& row : Csv(golden("xyz_resampled.csv")).rows) {
        const auto basis = bases.find(row.at("method"));
        if (basis == bases.end() || row.at("dataset") != "ohta")
            continue;
        const auto nm = steps(380, number(row, "step_nm"), 780);
        const auto patch = ohta.columns[static_cast<std::size_t>(number(row, "patch")) - 1];
        std::vector<double> values;
        for (const double l : nm)
            values.push_back(number(sprague.rows[static_cast<std::size_t>(l - 360)], patch));
        const auto plan = plan_of(set_of(Family::T, nm), "to=xyz&basis=" + basis->second +
                                                             "&illuminant=" + row.at("illuminant") +
                                                             "&observer=" + observer_of(row))
                              .value();
        const auto xyz = outputs_of(plan, values);
        const std::string where = row.at("method") + " " + row.at("illuminant") + " " + row.at("step_nm");
        bound.see_relative(100 * xyz[0], number(row, "X"), where + " X");
        bound.see_relative(100 * xyz[1], number(row, "Y"), where + " Y");
        bound.see_relative(100 * xyz[2], number(row, "Z"), where + " Z");
    }
}

/// A spectral line of unit power in a bin of width h is a bin average of 1 / h; its XYZ is then the
/// average of the colour-matching functions over the bin.
TEST(GoldenBasis, LinesInBinsHaveTheAverageOfTheColourMatchingFunctions) {
    const double y_sum = integral(
        find_observer("cie1931")->curves[1],
        [] {
            NmSamples ones{};
            ones.fill(1);
            return ones;
        }(),
        Quadrature::Sum1nm);
    Bound bound("G14 relative XYZ error of lines in bins", 1e-9);
    for (const auto& row : Csv(golden("lines.csv")).rows) {
        if (row.at("method") != "bin_average_cmf")
            continue;
        const double h = number(row, "step_nm"), line = number(row, "lambda_nm");
        const double first = row.at("phase") == "bin_start_360" ? 360 + h / 2 : 380;
        const auto nm = steps(first, h, 800);
        const auto plan = plan_of(set_of(Family::S0, nm), "to=xyz&basis=bins").value();
        std::size_t bin = 0;
        while (nm[bin] + h / 2 <= line)
            ++bin;
        const char* const columns[] = {"X", "Y", "Z"};
        for (std::size_t c = 0; c < 3; ++c)
            bound.see_relative(plan.weights.at(c, bin) * y_sum / h, number(row, columns[c]),
                               row.at("line") + " " + row.at("step_nm") + " " + row.at("phase"));
    }
}

}  // namespace
}  // namespace osio::test
