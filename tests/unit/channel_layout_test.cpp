// SPDX-License-Identifier: Apache-2.0
#include <osio/layout/channel_layout.h>
#include <osio/layout/presentation.h>
#include <osio/layout/spectral_metadata.h>

#include <support/sets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace osio {
namespace {

using Names = std::vector<std::string>;

ChannelLayout layout_of(const Names& names) {
    return parse_channel_layout(names, DecimalMark::Comma);
}

Names shown(const Names& names, BandNames style = BandNames::CommaFree) {
    Names out;
    for (const auto& channel : present_channels(layout_of(names), style))
        out.push_back(channel.name);
    return out;
}

TEST(ChannelLayout, BandsAreSortedByNumberNotByText) {
    const auto layout = layout_of({"S0.1000nm", "S0.400nm", "S0.50e1nm"});
    EXPECT_EQ(layout.sets.at(0).wavelengths_nm(), (std::vector<double>{400, 500, 1000}));
    EXPECT_EQ(layout.sets.at(0).bands.at(2).channel, 0U);
}

TEST(ChannelLayout, EveryChannelAppearsExactlyOnce) {
    Names names{"R", "A", "left.S0.400nm", "left.T.500nm", "T.400nm", "T.400nm.500nm", "Z", "S0.R"};
    std::mt19937 random(1);
    for (int i = 0; i < 50; ++i) {
        std::shuffle(names.begin(), names.end(), random);
        test::expect_each_channel_once(layout_of(names));
    }
}

TEST(ChannelLayout, RootsAndFamiliesAreSetsOfTheirOwn) {
    const auto layout = layout_of({"S0.400nm", "T.400nm", "left.T.400nm", "S1.400nm"});
    Names names;
    for (const SpectralSet& set : layout.sets)
        names.push_back(set.name());
    EXPECT_EQ(names, (Names{"S0", "S1", "T", "left.T"}));
    EXPECT_EQ(layout.sets[0].quantity(), Quantity::Radiance);
    EXPECT_EQ(layout.sets[2].quantity(), Quantity::Reflectance);
}

TEST(ChannelLayout, AlphaOfARootIsItsOwnElseThePlainOne) {
    const auto layout = layout_of({"A", "left.A", "left.T.400nm", "right.T.400nm", "T.400nm"});
    EXPECT_EQ(layout.sets.at(0).name(), "T");
    EXPECT_EQ(layout.alpha_of(layout.sets.at(0)), 0U);
    EXPECT_EQ(layout.alpha_of(layout.sets.at(1)), 1U);
    EXPECT_EQ(layout.alpha_of(layout.sets.at(2)), 0U);
}

TEST(ChannelLayout, DuplicatesAndNearMissesAreReported) {
    const auto layout = layout_of({"S0.400nm", "S0.4e2nm", "T.500nm", "T.400nm.500nm", "S0.550.5nm"});
    ASSERT_EQ(layout.warnings.size(), 2U);
    EXPECT_EQ(layout.warnings[0],
              "\"S0.400nm\", \"S0.4e2nm\" are the same wavelength, 400 nm; a collapse takes their mean");
    EXPECT_NE(layout.warnings[1].find("\"S0.550.5nm\" is no band"), std::string::npos);
}

TEST(Presentation, RgbaFirstThenBandsByWavelengthThenTheRest) {
    EXPECT_EQ(shown({"A", "B", "G", "R", "S0.1000nm", "S0.400nm", "T.450,5nm", "Z", "diffuse.R"}),
              (Names{"R", "G", "B", "A", "S0.400nm", "S0.1000nm", "T.450.5nm", "Z", "diffuse.R"}));
}

TEST(Presentation, NamesOfTheFileOnRequest) {
    EXPECT_EQ(shown({"T.450,000000nm"}, BandNames::AsStored), (Names{"T.450,000000nm"}));
    EXPECT_EQ(shown({"T.450,000000nm"}), (Names{"T.450nm"}));
}

TEST(Presentation, DuplicatesKeepNamesOfTheirOwn) {
    const Names names = shown({"T.400,0nm", "T.400nm", "T.4e2nm"});
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 3U);
    for (const std::string& name : names)
        EXPECT_EQ(parse_channel_name(name, DecimalMark::Point)->wavelength_nm, 400) << name;
}

TEST(Presentation, WrittenNamesAreTheLayoutsOwn) {
    const Names given{"R", "T.450nm", "T.450.5nm", "T.460,000000nm", "T.400nm.500.5nm", "S0.0,55um", "depth"};
    EXPECT_EQ(layout_names(given),
              (Names{"R", "T.450nm", "T.450,5nm", "T.460nm", "T.400nm.500,5nm", "S0.550nm", "depth"}));
}

TEST(Presentation, WrittenDuplicatesStayApartAndMeanTheSame) {
    const Names names = layout_names(Names{"T.400nm", "T.4e2nm", "T.400.0nm", "T.400,5nm", "T.4005e-1nm"});
    EXPECT_EQ(names, (Names{"T.400nm", "T.400,0nm", "T.400,00nm", "T.400,5nm", "T.400,50nm"}));
}

TEST(SpectralMetadata, MissingAndOddAttributesAreWarnings) {
    const auto layout = layout_of({"S0.400nm", "S1.400nm"});
    const auto none = read_spectral_metadata(layout, {});
    EXPECT_EQ(none.warnings.size(), 2U);  // version, units
    const auto odd = read_spectral_metadata(
        layout,
        {{"spectralLayoutVersion", "2.0"}, {"emissiveUnits", "cd"}, {"polarisationHandedness", "up"}});
    EXPECT_EQ(odd.warnings.size(), 3U);
    const auto good = read_spectral_metadata(layout, {{"spectralLayoutVersion", "1.0"},
                                                      {"emissiveUnits", "W.m^-2.sr^-1.nm^-1"},
                                                      {"polarisationHandedness", "left"}});
    EXPECT_TRUE(good.warnings.empty());
    EXPECT_TRUE(read_spectral_metadata(layout_of({"R"}), {}).warnings.empty());
}

TEST(SpectralMetadata, SensitivitiesBelongToTheirChannel) {
    const auto layout = layout_of({"S0.400,0nm", "S0.500nm"});
    const auto metadata = read_spectral_metadata(
        layout, {{"S0.400,0nm", "390nm:0;400nm:1;410nm:0;"}, {"cameraResponse", "400nm:1;x;"}});
    ASSERT_EQ(metadata.sensitivities.size(), 1U);
    EXPECT_EQ(metadata.sensitivities.at(0).values, (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(metadata.camera_response->values, (std::vector<double>{1}));
    EXPECT_TRUE(describes_bands("S0.400,0nm"));
    EXPECT_TRUE(describes_bands("EV"));
    EXPECT_FALSE(describes_bands("owner"));
}

}  // namespace
}  // namespace osio
