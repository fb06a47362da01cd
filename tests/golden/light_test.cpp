// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/daylight.h>
#include <osio/colour/display.h>
#include <osio/colour/planckian.h>

#include <support/bound.h>
#include <support/csv.h>
#include <support/sets.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace osio::test {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

TEST(GoldenLight, PlanckIsRightWhereverItIsANormalNumber) {
    Bound bound("G9 Planck's relative error as a share of 1e-15 + 2.5e-16 x", 1);
    for (const auto& row : Csv(golden("planck.csv")).rows) {
        const double expected = number(row, "L_nm_float64");
        const double actual = planck_radiance_w_m2_sr_nm(number(row, "lambda_nm"), number(row, "T_K"));
        const std::string where = row.at("T_K") + " K " + row.at("lambda_nm") + " nm";
        if (!std::isnormal(expected)) {
            EXPECT_LT(actual, 1e-300) << where;
            continue;
        }
        const double x = number(row, "x=hc/(lambda k T)");
        bound.see_absolute(std::abs(actual / expected - 1) / (1e-15 + 2.5e-16 * x), 0, where);
    }
    EXPECT_EQ(planck_radiance_w_m2_sr_nm(500, 0), 0);
    EXPECT_EQ(planck_radiance_w_m2_sr_nm(500, -1), 0);
}

TEST(GoldenLight, BlackbodiesHaveTheirChromaticity) {
    Bound bound("absolute xy error of blackbodies", 1e-12);
    const Observer observer = find_observer("cie1931").value();
    for (const auto& row : Csv(golden("blackbody_xy.csv")).rows) {
        const auto light = find_illuminant("blackbody(" + row.at("T_K") + ")");
        ASSERT_TRUE(light) << light.error().text();
        const Vector3 white = white_point(*light, observer).value();
        const double sum = white[0] + white[1] + white[2];
        bound.see_absolute(white[0] / sum, number(row, "x_2deg"), row.at("T_K"));
        bound.see_absolute(white[1] / sum, number(row, "y_2deg"), row.at("T_K"));
    }
}

TEST(GoldenLight, DaylightIsTheTableOfItsNominalTemperature) {
    const NmSamples table = find_illuminant("D65")->power;
    const NmSamples formula = daylight_power(6500 * 1.4388 / 1.438).value();
    Bound bound("D(6503.6) against the D65 table", 0.0008);
    for (std::size_t i = 0; i < table.size(); i += 10)  // S0, S1, S2 are tables of 10 nm
        bound.see_absolute(formula[i], table[i], std::to_string(360 + i));
    EXPECT_FALSE(daylight_power(3999));
    EXPECT_FALSE(daylight_power(25001));
    EXPECT_FALSE(daylight_power(std::nan("")));
}

TEST(GoldenLight, LuminanceAndScotopicLuminance) {
    const auto set = set_of(Family::S0, steps(360, 1, 830));
    const auto photopic = plan_of(set, "to=luminance&scale=photometric&basis=linear").value();
    const auto scotopic =
        plan_of(set, "to=luminance&scale=photometric&observer=scotopic&basis=linear").value();
    Bound bound("G10 relative error of luminances", 1e-12);
    for (const auto& row : Csv(golden("luminance.csv")).rows) {
        const std::string name = row.at("spectrum").substr(0, row.at("spectrum").find(' '));
        std::vector<double> radiance(471, 1.0);
        if (name != "flat") {
            const NmSamples power = find_illuminant(name)->power;
            for (std::size_t i = 0; i < radiance.size(); ++i)
                radiance[i] = power[i] / power[560 - 360];
        }
        bound.see_relative(outputs_of(photopic, radiance)[0], number(row, "Y_683_sum1nm_cd_m2"), name);
        bound.see_relative(outputs_of(scotopic, radiance)[0], number(row, "scotopic_1700"),
                           name + " scotopic");
    }
}

TEST(GoldenLight, DisplaysShowWhatTheirPrimariesEmit) {
    const Observer observer = find_observer("cie1931").value();
    const std::map<std::string, std::string> tables{
        {"Apple_Studio_Display", "display_apple_studio.csv"},
        {"Typical_CRT_Brainard_1997", "display_crt_brainard.csv"}};
    Bound bound("relative XYZ error of displays", 1e-12);
    for (const auto& row : Csv(golden("display_rgb.csv")).rows) {
        const auto table = tables.find(row.at("display"));
        if (table == tables.end())
            continue;
        const Display display = display_from_csv(text_of(golden(table->second)), table->second).value();
        const Vector3 rgb{number(row, "r"), number(row, "g"), number(row, "b")};
        const Vector3 xyz = display.xyz_from_rgb(observer) * rgb;
        const std::string where = row.at("display") + " " + row.at("r");
        bound.see_relative(xyz[0], number(row, "X_rel_white_Y1"), where + " X");
        bound.see_relative(xyz[1], number(row, "Y"), where + " Y");
        bound.see_relative(xyz[2], number(row, "Z"), where + " Z");

        // The spectrum that the RGB shows, collapsed to the display, is the RGB again.
        const Spectrum shown = display.spectrum_of(rgb);
        const auto plan =
            make_plan(set_of(Family::S0, shown.wavelengths_nm),
                      request_of("to=display&display=d.csv&basis=linear&extrapolate=zero&scale=integral"),
                      [&](std::string_view) -> Result<std::string> { return text_of(golden(table->second)); })
                .value();
        const auto again = outputs_of(plan, shown.values);
        const auto white = outputs_of(plan, display.spectrum_of({1, 1, 1}).values);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(again[c] / white[c], rgb[c], 1e-12) << where;
    }
}

}  // namespace
}  // namespace osio::test
