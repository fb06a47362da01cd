// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/gdal_metadata.h>
#include <formats/tiff/page_bands.h>
#include <formats/tiff/tiff_writer.h>
#include <formats/tiff/xmp_bands.h>

#include <gtest/gtest.h>

namespace osio::tiff {
namespace {

TEST(GdalMetadata, ItemsComeBackFromTheirText) {
    const std::vector<GdalItem> items{{"wavelength", "450.5", 0, {}, {}},
                                      {"DESCRIPTION", "a < b & \"c\"\nsecond line", 1, {}, "description"},
                                      {"string note", "  ", {}, "EXR", {}},
                                      {"empty", "", {}, {}, {}}};
    const auto back = parse_gdal_metadata(gdal_metadata_text(items));
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(*back, items);
}

TEST(GdalMetadata, WhatIsNoneIsDamage) {
    for (const char* text : {"", "wavelength = 400", "<GDALMetadata><Item>", "<Other/>",
                             "<GDALMetadata><Item name='a' sample='-1'>1</Item></GDALMetadata>",
                             "<GDALMetadata><Item name='a' sample='x'>1</Item></GDALMetadata>"}) {
        const auto items = parse_gdal_metadata(text);
        ASSERT_FALSE(items) << text;
        EXPECT_EQ(items.error().code, ErrorCode::Damaged);
    }
}

TEST(GdalMetadata, WhatTheWriterStatesIsReadAsWhatItWas) {
    TiffOutput output;
    output.quantity = Quantity::Radiance;
    output.wavelengths_nm = {380.25, 1000, 2500.125};
    output.fwhm_nm = {5, 6.5, 10};
    output.items = {{"string emissiveUnits", "W.m^-2.sr^-1", {}, "EXR", {}}};
    Page page;
    page.samples = 3;
    page.gdal_metadata = gdal_metadata_text(items_of(output));
    const auto bands = read_bands(page);
    ASSERT_TRUE(bands) << bands.error().text();
    for (std::size_t band = 0; band < 3; ++band) {
        EXPECT_EQ(bands->facts[band].wavelength_nm, output.wavelengths_nm[band]);
        EXPECT_EQ(bands->facts[band].fwhm_nm, output.fwhm_nm[band]);
    }
    EXPECT_EQ(bands->quantity, Quantity::Radiance);
    EXPECT_TRUE(bands->warnings.empty()) << bands->warnings.front();
    EXPECT_EQ(bands->others, output.items);
}

TEST(GdalMetadata, TwoStatementsThatDifferAreSaid) {
    Page page;
    page.samples = 1;
    page.gdal_metadata =
        "<GDALMetadata><Item name='wavelength' sample='0'>450</Item>"
        "<Item name='wavelength_units' sample='0'>nm</Item>"
        "<Item name='CENTRAL_WAVELENGTH_UM' sample='0' domain='IMAGERY'>0.46</Item></GDALMetadata>";
    const auto bands = read_bands(page).value();
    EXPECT_EQ(bands.facts[0].wavelength_nm, 450);
    ASSERT_EQ(bands.warnings.size(), 1U);
    EXPECT_NE(bands.warnings[0].find("has 450 nm by \"wavelength\" and 460 nm"), std::string::npos);
}

TEST(XmpBands, AttributesElementsAndListsAreRead) {
    const auto packet = [](const std::string& description) {
        return "<x:xmpmeta><rdf:RDF>" + description + "</rdf:RDF></x:xmpmeta>";
    };
    for (const std::string& description :
         {std::string("<rdf:Description Camera:CentralWavelength='475' Camera:WavelengthFWHM='32'/>"),
          std::string("<rdf:Description a='b'/><rdf:Description><Camera:CentralWavelength>475"
                      "</Camera:CentralWavelength><Camera:WavelengthFWHM>32</Camera:WavelengthFWHM>"
                      "</rdf:Description>"),
          std::string("<rdf:Description Camera:WavelengthFWHM='32'><Camera:CentralWavelength><rdf:Seq>"
                      "<rdf:li>475</rdf:li></rdf:Seq></Camera:CentralWavelength></rdf:Description>")}) {
        const XmpBand band = read_xmp_band(packet(description));
        EXPECT_EQ(band.wavelength_nm, 475) << description;
        EXPECT_EQ(band.fwhm_nm, 32) << description;
    }
    EXPECT_EQ(read_xmp_band("no XML <").wavelength_nm, 0);
    EXPECT_EQ(read_xmp_band(packet("<rdf:Description Camera:CentralWavelength='blue'/>")).wavelength_nm, 0);
}

}  // namespace
}  // namespace osio::tiff
