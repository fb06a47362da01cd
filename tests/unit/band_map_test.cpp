// SPDX-License-Identifier: Apache-2.0
#include <osio/layout/band_map.h>
#include <osio/layout/part_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace osio {
namespace {

using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

Numbers steps_of(const std::string& text) {
    const auto map = parse_band_steps(text);
    return map ? map->steps_nm : Numbers();
}

std::string refusal(const std::string& text) {
    const auto map = parse_band_steps(text);
    EXPECT_FALSE(map) << text;
    if (map)
        return {};
    EXPECT_EQ(map.error().code, ErrorCode::Usage) << text;
    return map.error().text();
}

std::string table_refusal(const std::string& csv) {
    const auto map = parse_band_table(csv, "map.csv");
    EXPECT_FALSE(map) << csv;
    if (map)
        return {};
    EXPECT_EQ(map.error().code, ErrorCode::Usage) << csv;
    return map.error().text();
}

bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

/// The wavelengths that a map gives, 0 for channels that it leaves out.
Numbers placed(const BandMap& map, const Names& names) {
    const auto places = map_bands(map, names);
    EXPECT_TRUE(places) << (places ? "" : places.error().text());
    Numbers out;
    if (places)
        for (const auto& place : *places)
            out.push_back(place ? place->wavelength_nm : 0);
    return out;
}

TEST(BandMap, ARangeIsItsStepsInWhateverUnit) {
    EXPECT_EQ(steps_of("400:10:430"), (Numbers{400, 410, 420, 430}));
    EXPECT_EQ(steps_of("0.4:0.01:0.43um"), (Numbers{400, 410, 420, 430}));
    EXPECT_EQ(steps_of("0.4um:10nm:430"), (Numbers{400, 410, 420, 430}));
    EXPECT_EQ(steps_of(" 400 : 3.3 : 406.6 "), (Numbers{400, 403.3, 406.6}));
    EXPECT_EQ(steps_of("550:1:550"), (Numbers{550}));
    EXPECT_EQ(steps_of("400:10:700").size(), 31U);
    // Decimal steps give decimal wavelengths: the twin counts in tenths.
    const Numbers tenths = steps_of("380:0.1:780");
    ASSERT_EQ(tenths.size(), 4001U);
    for (std::size_t i = 0; i < tenths.size(); ++i)
        ASSERT_EQ(tenths[i], static_cast<double>(3800 + i) / 10) << i;
}

TEST(BandMap, WhatIsNoRangeIsRefusedWithTheReason) {
    EXPECT_TRUE(says(refusal("400:700"), "has 2 numbers"));
    EXPECT_TRUE(says(refusal("400:10:700:1"), "has 4 numbers"));
    EXPECT_TRUE(says(refusal("400:ten:700"), "holds \"ten\""));
    EXPECT_TRUE(says(refusal("400:0:700"), "holds \"0\""));
    EXPECT_TRUE(says(refusal("400:-10:700"), "holds \"-10\""));
    EXPECT_TRUE(says(refusal("400:10:700THz"), "no length"));
    EXPECT_TRUE(says(refusal("700:10:400"), "ends below its start"));
    EXPECT_TRUE(says(refusal("400:7:700"), "400 nm plus 42 steps are 694 nm"));
    EXPECT_TRUE(says(refusal("1:1e-6:1000"), "more wavelengths than a file has channels"));
    EXPECT_TRUE(says(refusal("1:1e-10:1.000000001"), "steps that are too small"));
    EXPECT_TRUE(says(refusal(""), "expected START:STEP:END such as 400:10:700"));
    EXPECT_TRUE(says(refusal("400:10:1e999"), "no length"));
}

TEST(BandMap, ARangeIsForNumberedChannelsInNumericOrder) {
    const BandMap map = parse_band_steps("400:10:430").value();
    EXPECT_EQ(placed(map, {"0", "1", "10", "2"}), (Numbers{400, 410, 430, 420}));
    EXPECT_EQ(placed(map, {"A", "B", "G", "R", "b10", "b11", "b9", "b9a", "left.A", "Z"}),
              (Numbers{0, 0, 0, 0, 420, 430, 400, 410, 0, 0}));
    // Where channels are numbers, others are none of them.
    EXPECT_EQ(placed(map, {"1", "2", "3", "4", "depth"}), (Numbers{400, 410, 420, 430, 0}));
    // Of equal numbers the file's order stands.
    EXPECT_EQ(placed(map, {"b01", "b1", "b001", "b2"}), (Numbers{400, 410, 420, 430}));
}

TEST(BandMap, NumericOrderIsTheOrderOfTheNumbers) {
    std::mt19937 random(3);
    Names names;
    for (int i = 0; i < 300; ++i)
        names.push_back("band" + std::to_string(i) + (i % 2 ? "_red" : "_a"));
    std::shuffle(names.begin(), names.end(), random);
    const auto places = placed(parse_band_steps("1000:1:1299").value(), names);
    for (std::size_t i = 0; i < names.size(); ++i)
        EXPECT_EQ(places[i], 1000 + std::stoi(names[i].substr(4))) << names[i];
}

TEST(BandMap, ANumberOfChannelsThatDoesNotFitIsSaidWithBothNumbers) {
    const auto refused = map_bands(parse_band_steps("400:10:700").value(), Names{"0", "1", "2", "3", "4"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Contradiction);
    EXPECT_EQ(refused.error().text(),
              "wavelengths=400:10:700 are 31 wavelengths, and there are 5 channels to give them to (\"0\", "
              "\"1\", \"2\", \"3\", ...); a .csv of lines channel,nm says which channels are bands");
    EXPECT_TRUE(says(map_bands(parse_band_steps("400:10:700").value(), Names{"R", "G", "B"}).error().text(),
                     "there are 0 channels"));
}

TEST(BandMap, ATableNamesChannels) {
    const auto map =
        parse_band_table("channel,nm,fwhm\n# a comment\r\nred, 650 ,20\r\nblue,0.45um\n\n", "map.csv");
    ASSERT_TRUE(map) << map.error().text();
    EXPECT_EQ(placed(*map, {"blue", "green", "red"}), (Numbers{450, 0, 650}));
    EXPECT_EQ(map->channels.at(0).fwhm_nm, 20);
    EXPECT_EQ(map->channels.at(1).fwhm_nm, std::nullopt);
    const auto quoted = parse_band_table("\"T.450,5nm\",450\nT.460nm,460", "map.csv").value();
    EXPECT_EQ(placed(quoted, {"T.450,5nm", "T.460nm"}), (Numbers{450, 460}));
    const auto semicolons = parse_band_table("T.450,5nm;450\nb\t460", "map.csv").value();
    EXPECT_EQ(placed(semicolons, {"T.450,5nm", "b"}), (Numbers{450, 460}));
    EXPECT_EQ(placed(parse_band_table("b,550", "map.csv").value(), {"b"}), (Numbers{550}));
}

TEST(BandMap, ATableThatIsNoneIsRefusedByLine) {
    EXPECT_TRUE(
        says(table_refusal("a,400\na,410\n"), "map.csv: line 2: names the channel \"a\" for a second time"));
    EXPECT_TRUE(
        says(table_refusal("a,400\nb,0.4um\n"), "line 2: gives \"b\" the wavelength of \"a\", 400 nm"));
    EXPECT_TRUE(says(table_refusal("a,400\nb,red\n"), "line 2: found \"red\", expected a wavelength"));
    EXPECT_TRUE(says(table_refusal("a,400\nb,-1\n"), "found \"-1\""));
    EXPECT_TRUE(says(table_refusal("a,4OO\n"), "line 1: found \"4OO\""));  // no header: it has a digit
    EXPECT_TRUE(says(table_refusal("a,400,0\n"), "found \"0\", expected a width"));
    EXPECT_TRUE(says(table_refusal("a\n"), "line 1: has 1 columns"));
    EXPECT_TRUE(says(table_refusal("a,1,2,3\n"), "has 4 columns"));
    EXPECT_TRUE(says(table_refusal("channel,nm\n"), "holds no line channel,nm"));
    EXPECT_TRUE(says(table_refusal(""), "holds no line channel,nm"));
    const auto refused = map_bands(parse_band_table("bleu,450", "map.csv").value(), Names{"blue", "red"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Contradiction);
    EXPECT_EQ(refused.error().text(),
              "map.csv: names the channel \"bleu\", which the file does not have; did you mean \"blue\"?");
}

/// A part's layout, which must be one.
ChannelLayout layout_of(const Names& names, const OpenWords& words) {
    auto part = read_part_layout(names, {}, words);
    EXPECT_TRUE(part) << (part ? "" : part.error().text());
    return part ? part->layout : ChannelLayout();
}

TEST(PartLayout, AMapMakesBandsOfReflectanceAloud) {
    const OpenWords words{parse_band_steps("400:10:430").value(), std::nullopt};
    const auto layout = layout_of({"0", "1", "2", "3"}, words);
    ASSERT_EQ(layout.sets.size(), 1U);
    EXPECT_EQ(layout.sets[0].name(), "T");
    EXPECT_EQ(layout.sets[0].wavelengths_nm(), (Numbers{400, 410, 420, 430}));
    EXPECT_EQ(layout.channel_names, (Names{"0", "1", "2", "3"}));
    EXPECT_EQ(layout.dialect.evidence, "wavelengths=400:10:430");
    ASSERT_EQ(layout.warnings.size(), 1U);
    EXPECT_TRUE(says(layout.warnings[0], "quantity=radiance"));
}

TEST(PartLayout, TheWordSaysWhatTheFileDoesNot) {
    const OpenWords words{parse_band_steps("400:10:410").value(), Quantity::Radiance};
    const auto layout = layout_of({"0", "1"}, words);
    EXPECT_EQ(layout.sets.at(0).name(), "S0");
    EXPECT_TRUE(layout.warnings.empty());
}

TEST(PartLayout, NamesOfTheLayoutKeepRootAndFamilyUnderAMap) {
    const OpenWords words{parse_band_steps("500:10:510").value(), std::nullopt};
    const auto layout = layout_of({"R", "left.S0.400nm", "left.S0.410nm"}, words);
    ASSERT_EQ(layout.sets.size(), 1U);
    EXPECT_EQ(layout.sets[0].name(), "left.S0");
    EXPECT_EQ(layout.sets[0].wavelengths_nm(), (Numbers{500, 510}));
    EXPECT_EQ(layout.others, (std::vector<std::size_t>{0}));
    EXPECT_TRUE(layout.warnings.empty());
}

TEST(PartLayout, AWordThatTheNamesDenyIsRefused) {
    const auto refused =
        read_part_layout(Names{"T.400nm", "T.410nm"}, {}, {std::nullopt, Quantity::Radiance});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Contradiction);
    EXPECT_EQ(refused.error().text(), "quantity=radiance does not fit: the bands are T by the spectral EXR "
                                      "layout, which is reflectance");
    EXPECT_TRUE(read_part_layout(Names{"T.400nm"}, {}, {std::nullopt, Quantity::Reflectance}));
    EXPECT_TRUE(read_part_layout(Names{"T.400nm", "S0.400nm"}, {}, {std::nullopt, Quantity::Radiance}));
    EXPECT_TRUE(read_part_layout(Names{"R"}, {}, {std::nullopt, Quantity::Radiance}));
}

}  // namespace
}  // namespace osio
