// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/part_layout.h>
#include <osio/layout/presentation.h>

#include <support/sets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace osio {
namespace {

using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

PartLayout part_of(const Names& names, const HeaderAttributes& header = {}, const OpenWords& words = {}) {
    auto part = read_part_layout(names, header, words);
    EXPECT_TRUE(part) << (part ? "" : part.error().text());
    return part ? *part : PartLayout();
}

/// "set nm nm;set nm": what a part holds.
std::string bands_of(const PartLayout& part) {
    std::string out;
    for (const SpectralSet& set : part.layout.sets) {
        out += (out.empty() ? "" : ";") + set.name();
        for (const double nm : set.wavelengths_nm())
            out += " " + format_double(nm);
    }
    return out;
}

bool warns(const PartLayout& part, const std::string& words) {
    return std::any_of(part.layout.warnings.begin(), part.layout.warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

std::string attribute_of(const PartLayout& part, std::string_view name) {
    const auto found = part.attributes.find(name);
    return found == part.attributes.end() ? "" : found->second;
}

constexpr const char* kAssumed = "taken as reflectance; quantity=radiance";

TEST(Dialect, MitsubaBinsAreRadianceBetweenTheirEdges) {
    const auto part = part_of({"395.00-405.00nm", "405.00-415.00nm", "415.00-425.00nm", "A"},
                              {{{"generated-by", "Mitsuba version 0.4.1"}}, {}});
    EXPECT_EQ(bands_of(part), "S0 400 410 420");
    EXPECT_EQ(attribute_of(part, attribute::kBinEdges), "395;405;415;425");
    EXPECT_EQ(part.layout.dialect.name, "Mitsuba 0.x bins");
    EXPECT_EQ(part.layout.dialect.evidence,
              "3 names such as \"395.00-405.00nm\"; generated-by \"Mitsuba version 0.4.1\"");
    EXPECT_TRUE(part.layout.warnings.empty());
    EXPECT_EQ(part.layout.alpha_of(part.layout.sets.at(0)), 3U);
    // As its film rounds 14 bins of 360 to 830 nm: two roundings of one edge differ.
    EXPECT_EQ(attribute_of(part_of({"360.00-393.57nm", "393.57-427.14nm", "427.15-460.71nm"}),
                           attribute::kBinEdges),
              "360;393.57;427.145;460.71");
}

TEST(Dialect, LayersOfMitsubaAreSetsWithTheirAlpha) {
    const auto part = part_of({"A", "left.395.00-405.00nm", "left.405.00-415.00nm", "left.A",
                               "right.v.395.00-405.00nm", "right.v.405.00-415.00nm"});
    EXPECT_EQ(bands_of(part), "left.S0 400 410;right.v.S0 400 410");
    EXPECT_EQ(attribute_of(part, attribute::kBinEdges), "395;405;415");
    EXPECT_EQ(part.layout.alpha_of(part.layout.sets.at(0)), 3U);
    EXPECT_EQ(part.layout.alpha_of(part.layout.sets.at(1)), 0U);
}

TEST(Dialect, BinsWithGapsOrOfTheirOwnCountAsBinsAloud) {
    const auto gap = part_of({"395.00-405.00nm", "410.00-420.00nm"});
    EXPECT_EQ(bands_of(gap), "S0 400 415");
    EXPECT_EQ(attribute_of(gap, attribute::kBinEdges), "");
    EXPECT_EQ(attribute_of(gap, attribute::kBasis), "bins");
    EXPECT_TRUE(warns(gap, "leave gaps or overlap"));
    EXPECT_TRUE(warns(part_of({"395.00-405.00nm", "400.00-410.00nm"}), "leave gaps or overlap"));
    const auto own =
        part_of({"a.395.00-405.00nm", "a.405.00-415.00nm", "b.395.00-405.00nm", "b.405.00-425.00nm"});
    EXPECT_EQ(attribute_of(own, attribute::kBinEdges), "");
    EXPECT_TRUE(warns(own, "layers have bins of their own"));
    // A bin that ends below its start is none.
    EXPECT_EQ(bands_of(part_of({"405.00-395.00nm", "415.00-405.00nm"})), "");
}

TEST(Dialect, IndigoBucketsStartAtTheirNamesAndCountMetres) {
    const auto part =
        part_of({"wavelength400", "wavelength430_25", "wavelength460_5", "wavelength490_75", "A"});
    EXPECT_EQ(bands_of(part), "S0 415.125 445.375 475.625 505.875");
    EXPECT_EQ(attribute_of(part, attribute::kBinEdges), "400;430.25;460.5;490.75;521");
    EXPECT_EQ(attribute_of(part, attribute::kEmissiveUnits), "W.m^-2.sr^-1");
    EXPECT_EQ(part.scale, 1e-9);
    EXPECT_TRUE(warns(part, "times 1e-9"));
    EXPECT_EQ(bands_of(part_of({"B", "G", "R", "spectral.wavelength400", "spectral.wavelength410"})),
              "S0 405 415");
    const auto unequal = part_of({"wavelength400", "wavelength410", "wavelength430"});
    EXPECT_EQ(attribute_of(unequal, attribute::kBinEdges), "400;410;430;450");
    EXPECT_TRUE(warns(unequal, "not equally wide"));
    EXPECT_EQ(part_of({"395.00-405.00nm", "405.00-415.00nm"}).scale, 1);
}

TEST(Dialect, IsetCountsFrom400By10) {
    Names names;
    for (int i = 31; i >= 1; --i)
        names.push_back("Radiance.C" + std::string(i < 10 ? "0" : "") + std::to_string(i));
    const auto part = part_of(names);
    EXPECT_EQ(part.layout.sets.at(0).name(), "S0");
    EXPECT_EQ(part.layout.sets.at(0).wavelengths_nm().size(), 31U);
    EXPECT_EQ(part.layout.sets.at(0).bands.at(30).channel, 0U);
    EXPECT_EQ(part.layout.sets.at(0).bands.at(30).wavelength_nm, 700);
    EXPECT_TRUE(part.layout.warnings.empty());
    names.resize(16);
    EXPECT_TRUE(warns(part_of(names), "16 bands of ISET3D"));
}

TEST(Dialect, OceanStatesMetresInAnAttribute) {
    const HeaderAttributes header{
        {}, {{"wl0.wavelength", "5.5e-07"}, {"wl1.wavelength", "4.5e-07"}, {"EV", "0"}}};
    const auto part = part_of({"wl0", "wl1", "wl2"}, header);
    EXPECT_EQ(bands_of(part), "T 450 550");
    EXPECT_TRUE(warns(part, kAssumed));
    EXPECT_EQ(part.layout.dialect.attributes, (Names{"wl0.wavelength", "wl1.wavelength"}));
    EXPECT_EQ(bands_of(part_of({"wl0", "wl1"}, header, {std::nullopt, Quantity::Radiance})), "S0 450 550");
    EXPECT_EQ(
        bands_of(part_of({"wl0", "wl1"}, {{}, {{"wl0.wavelength", "5.5e-07"}, {"wl1.wavelength", "0"}}})),
        "");
}

TEST(Dialect, GdalKeepsWhatEnviCalledABand) {
    const auto part = part_of({"Band1", "Band10", "Band2"}, {{{"gdal:Band_1", "366.551 nm"},
                                                              {"gdal:Band_2", "0.4 Micrometers"},
                                                              {"gdal:Band_10", "dark current"}},
                                                             {}});
    EXPECT_EQ(bands_of(part), "T 366.551 400");
    EXPECT_TRUE(warns(part, "1 of 3 bands have no wavelength"));
    EXPECT_TRUE(warns(part, kAssumed));
    const auto none = part_of({"Band1", "Band2"}, {{{"gdal:AREA_OR_POINT", "Area"}}, {}});
    EXPECT_EQ(bands_of(none), "");
    EXPECT_TRUE(warns(none, "GDAL bands (names Band1 and on, attributes gdal:), which say no wavelengths"));
    EXPECT_EQ(part_of({"Band1", "Band2"}).layout.dialect.name, "");
}

TEST(Dialect, ANumberWithItsUnitInEveryName) {
    EXPECT_EQ(bands_of(part_of({"A", "R", "b_450nm", "b_550nm", "b_1.5um"})), "T 450 550 1500");
    EXPECT_EQ(bands_of(part_of({"450nm", "550,5nm", "650.25 nm"})), "T 450 550.5 650.25");
    EXPECT_EQ(bands_of(part_of({"left.b_450nm", "left.b_550nm", "reflectance.0.65\xC2\xB5m"})),
              "left.T 450 550;reflectance.T 650");
    EXPECT_EQ(bands_of(part_of({"a.b.550.5nm", "a.b.560.5nm"})), "a.b.T 550.5 560.5");
    EXPECT_EQ(bands_of(part_of({"band1.550nm", "band1.560nm"})), "band1.T 550 560");
    EXPECT_EQ(bands_of(part_of({"f_500THz", "f_600THz"})).substr(0, 9), "T 499.654");
    EXPECT_TRUE(warns(part_of({"450nm", "550nm"}), kAssumed));
    EXPECT_EQ(bands_of(part_of({"450nm", "550nm"}, {}, {std::nullopt, Quantity::Radiance})), "S0 450 550");
    EXPECT_EQ(part_of({"450nm", "550nm"}).layout.dialect.evidence,
              "2 names such as \"450nm\", each with one wavelength");
    // One that has none, two in one, a range, one alone: no rule, no guess.
    for (const Names& names :
         {Names{"450nm", "550nm", "depth"}, Names{"450nm.460nm", "550nm.560nm"},
          Names{"b395-405nm", "b405-415nm"}, Names{"R", "550nm"}, Names{"5nmea", "6nmea"}})
        EXPECT_EQ(bands_of(part_of(names)), "") << names[0];
}

TEST(Dialect, TrapsAreNoBands) {
    // Mitsuba 3's Stokes channels; the early draft's reradiation; a point for a comma.
    EXPECT_EQ(bands_of(part_of({"S0.B", "S0.G", "S0.R", "S1.B", "S1.G", "S1.R"})), "");
    EXPECT_EQ(bands_of(part_of({"S0.400nm.500nm", "S0.400nm.600nm", "S0.500nm.600nm"})), "");
    const auto point = part_of({"S0.550.5nm", "S0.560.5nm"});
    EXPECT_EQ(bands_of(point), "");
    EXPECT_TRUE(warns(point, "a comma as decimal mark"));
    EXPECT_EQ(bands_of(part_of({"R", "G", "B"})), "");
    EXPECT_EQ(bands_of(part_of({})), "");
}

TEST(Dialect, ProgramsThatSayNoWavelengthsAreNamedAndTakeAMap) {
    const OpenWords map{parse_band_steps("400:10:420").value(), std::nullopt};
    const auto opencv = part_of({"0", "1", "2"});
    EXPECT_EQ(bands_of(opencv), "");
    EXPECT_TRUE(warns(opencv,
                      "OpenCV's numbered channels (names 0 to 2), which say no wavelengths; give them with "
                      "wavelengths=400:10:700"));
    EXPECT_EQ(bands_of(part_of({"0", "1", "2"}, {}, map)), "T 400 410 420");
    const HeaderAttributes mitsuba3{{{"generatedBy", "Mitsuba version 3.5.0"}}, {}};
    const auto film = part_of({"A", "band1_red", "band2_green", "band3_blue"}, mitsuba3);
    EXPECT_EQ(bands_of(film), "");
    EXPECT_TRUE(warns(film, "Mitsuba 3 film bands"));
    const auto mapped = part_of({"A", "band1_red", "band2_green", "band3_blue"}, mitsuba3, map);
    EXPECT_EQ(bands_of(mapped), "S0 400 410 420");
    EXPECT_TRUE(mapped.layout.warnings.empty());
    EXPECT_EQ(part_of({"R", "S0.R", "S1.R"}, mitsuba3).layout.dialect.name, "");
}

TEST(Dialect, TheFirstThatFitsWins) {
    const HeaderAttributes ocean{
        {{"gdal:Band_1", "600 nm"}, {"gdal:Band_2", "610 nm"}},
        {{"395.00-405.00nm.wavelength", "5e-07"}, {"405.00-415.00nm.wavelength", "6e-07"}}};
    const Names bins{"395.00-405.00nm", "405.00-415.00nm"};
    const Names indigo{"wavelength400", "wavelength410"}, iset{"Radiance.C01", "Radiance.C02"};
    const Names gdal{"Band1", "Band2"}, layout{"T.700nm"}, generic{"450nm", "550nm"};
    const auto joined = [](std::initializer_list<Names> lists) {
        Names out;
        for (const Names& list : lists)
            out.insert(out.end(), list.begin(), list.end());
        return out;
    };
    EXPECT_EQ(part_of(joined({bins, indigo, iset, gdal, layout}), ocean).layout.dialect.name, kLayoutDialect);
    EXPECT_EQ(part_of(joined({bins, indigo, iset, gdal}), ocean).layout.dialect.name, "Ocean channels");
    EXPECT_EQ(part_of(joined({bins, indigo, iset, gdal}), {ocean.texts, {}}).layout.dialect.name,
              "Mitsuba 0.x bins");
    EXPECT_EQ(part_of(joined({indigo, iset, gdal}), ocean).layout.dialect.name, "Indigo buckets");
    EXPECT_EQ(part_of(joined({iset, gdal}), ocean).layout.dialect.name, "ISET3D bands");
    EXPECT_EQ(part_of(gdal, ocean).layout.dialect.name, "GDAL bands");
    EXPECT_EQ(part_of(generic, ocean).layout.dialect.name, "wavelengths in names");
    const OpenWords map{parse_band_table("450nm,470\n550nm,570", "m.csv").value(), std::nullopt};
    EXPECT_EQ(bands_of(part_of(generic, {}, map)), "T 470 570");
}

TEST(Dialect, AQuantityThatADialectDeniesIsRefused) {
    for (const Names& names :
         {Names{"395.00-405.00nm", "405.00-415.00nm"}, Names{"wavelength400", "wavelength410"},
          Names{"Radiance.C01", "Radiance.C02"}}) {
        const auto refused = read_part_layout(names, {}, {std::nullopt, Quantity::Reflectance});
        ASSERT_FALSE(refused) << names[0];
        EXPECT_EQ(refused.error().code, ErrorCode::Contradiction);
        EXPECT_TRUE(read_part_layout(names, {}, {std::nullopt, Quantity::Radiance}));
    }
}

TEST(Dialect, HostsAndFilesGetTheLayoutsNames) {
    const auto layout = part_of({"405.00-416.00nm", "395.00-405.00nm", "A"}).layout;
    EXPECT_EQ(layout.channel_names, (Names{"405.00-416.00nm", "395.00-405.00nm", "A"}));
    EXPECT_EQ(written_names(layout), (Names{"S0.410,5nm", "S0.400nm", "A"}));
    Names shown, stored;
    for (const auto& channel : present_channels(layout, BandNames::CommaFree))
        shown.push_back(channel.name);
    for (const auto& channel : present_channels(layout, BandNames::AsStored))
        stored.push_back(channel.name);
    EXPECT_EQ(shown, (Names{"A", "S0.400nm", "S0.410.5nm"}));
    EXPECT_EQ(stored, (Names{"A", "395.00-405.00nm", "405.00-416.00nm"}));
    // A name that another channel has already is not given twice.
    const OpenWords map{parse_band_table("a,550", "m.csv").value(), std::nullopt};
    EXPECT_EQ(written_names(part_of({"T.550nm", "a"}, {}, map).layout), (Names{"T.550nm", "T.550,0nm"}));
}

TEST(Dialect, ColourChannelsThatAMapMakesBandsAreShownOnce) {
    const OpenWords map{parse_band_table("R,650\nG,550\nA,450", "m.csv").value(), std::nullopt};
    const auto layout = part_of({"A", "B", "G", "R"}, {}, map).layout;
    Names shown;
    for (const auto& channel : present_channels(layout, BandNames::CommaFree))
        shown.push_back(channel.name);
    EXPECT_EQ(shown, (Names{"B", "T.450nm", "T.550nm", "T.650nm"}));
    EXPECT_EQ(layout.alpha_of(layout.sets.at(0)), std::nullopt);
}

TEST(Dialect, EveryChannelAppearsExactlyOnceWhateverItsName) {
    std::mt19937 random(5);
    const Names pieces{
        "395.00-405.00nm", "wavelength400", "Radiance.C01", "Band1", "0", "b_550nm", "T.400nm", ".",
        "spectral.",       "S0.",           "nm",           "1.5um", "A"};
    for (int round = 0; round < 400; ++round) {
        Names names;
        for (int i = 0; i < 6; ++i) {
            std::string name;
            for (auto k = random() % 3 + 1; k > 0; --k)
                name += pieces[random() % pieces.size()];
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
        }
        test::expect_each_channel_once(part_of(names).layout);
    }
}

}  // namespace
}  // namespace osio
