// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/envi_header.h>

#include <gtest/gtest.h>

#include <string>

namespace osio::envi {
namespace {

/// A header of three bands with more lines at its end.
std::string header_with(const std::string& lines) {
    return "ENVI\nsamples = 4\nlines = 5\nbands = 3\ndata type = 12\ninterleave = bil\n" + lines;
}

EnviHeader parsed(const std::string& lines) {
    const auto header = parse_header(header_with(lines));
    EXPECT_TRUE(header) << header.error().text();
    return header.value_or(EnviHeader{});
}

bool says(const EnviHeader& header, const std::string& words) {
    for (const std::string& warning : header.warnings)
        if (warning.find(words) != std::string::npos)
            return true;
    return false;
}

std::string refusal(const std::string& text, ErrorCode code) {
    const auto header = parse_header(text);
    EXPECT_FALSE(header) << text;
    if (header)
        return {};
    EXPECT_EQ(header.error().code, code) << header.error().text();
    return header.error().text();
}

const std::vector<double> kNm{450, 550.5, 650};

TEST(EnviHeader, KeysAreReadInAnySpelling) {
    const std::string text =
        "\xEF\xBB\xBF"
        "ENVI\r\n; a comment\r\nSAMPLES=4\r\n  Lines   =  5\r\nbands = 3\r\n"
        "Data_Type = 2\r\ndata  ignore\tvalue = -1\r\nINTERLEAVE = BIP\r\nbyte order = 1\r\n"
        "Wavelength = {\r\n 450\r\n, 550.5\r\n, 650 }\r\nwavelength units = Nanometers\r\n"
        "reflectance scale factor = 1e4\r\n";
    const auto header = parse_header(text);
    ASSERT_TRUE(header) << header.error().text();
    EXPECT_EQ(header->samples, 4U);
    EXPECT_EQ(header->lines, 5U);
    EXPECT_EQ(header->bands, 3U);
    EXPECT_EQ(header->type, DataType::Int16);
    EXPECT_EQ(header->interleave, Interleave::Bip);
    EXPECT_TRUE(header->big_endian);
    EXPECT_EQ(header->wavelengths_nm, kNm);
    EXPECT_EQ(header->divisor, 1e4);
    EXPECT_EQ(header->ignore_value, -1);
    EXPECT_EQ(header->data_size(), 4U * 5 * 3 * 2);
}

TEST(EnviHeader, UnitsOfWavelengthsAreConverted) {
    struct Case {
        std::string units, list;
        double first_nm, tolerance;
    };

    const std::vector<Case> cases{{"Nanometers", "450,550.5,650", 450, 0},
                                  {"nm", "450,550.5,650", 450, 0},
                                  {"Micrometers", "0.45,0.5505,0.65", 450, 0},
                                  {"um", "0.45,0.5505,0.65", 450, 0},
                                  {"\xC2\xB5m", "0.45,0.5505,0.65", 450, 0},
                                  {"\xB5m", "4.5e-1,0.5505,0.65", 450, 0},
                                  {"Wavenumber", "22222.22222222222,18165,15384", 450, 1e-9},
                                  {"GHz", "666205.4622222222,1,1", 450, 1e-9},
                                  {"MHz", "666205462.2222222,1,1", 450, 1e-9}};
    for (const Case& c : cases) {
        const EnviHeader header =
            parsed("wavelength units = " + c.units + "\nwavelength = {" + c.list + "}\n");
        ASSERT_EQ(header.wavelengths_nm.size(), 3U) << c.units;
        EXPECT_NEAR(header.wavelengths_nm[0], c.first_nm, c.tolerance) << c.units;
        EXPECT_FALSE(says(header, "wavelengths are taken")) << c.units;
    }
}

TEST(EnviHeader, AUnitThatIsNotStatedIsGuessedAloud) {
    for (const std::string units : {"", "wavelength units = Unknown\n", "wavelength units = furlongs\n"}) {
        const EnviHeader nm = parsed(units + "wavelength = {450,550.5,650}\n");
        EXPECT_EQ(nm.wavelengths_nm, kNm);
        EXPECT_TRUE(says(nm, "taken as nanometres")) << units;
        const EnviHeader micro = parsed(units + "wavelength = {0.45,0.5505,0.65}\n");
        EXPECT_EQ(micro.wavelengths_nm, kNm);
        EXPECT_TRUE(says(micro, "taken as micrometres")) << units;
    }
    const EnviHeader index = parsed("wavelength units = Index\nwavelength = {1,2,3}\n");
    EXPECT_TRUE(index.wavelengths_nm.empty());
    EXPECT_TRUE(says(index, "Index"));
}

TEST(EnviHeader, VariantsOfRealFilesAreRead) {
    EXPECT_EQ(parsed("wavelength units = nm\nwavelength = {\n,450\n,550.5\n,650}\n").wavelengths_nm, kNm);
    EXPECT_EQ(parsed("wavelength units = nm\nwavelength = [450, 550.5, 650]\n").wavelengths_nm, kNm);
    EXPECT_EQ(parsed("wavelength units = nm\nwavelength = {450,550.5,650,\n}\n").wavelengths_nm, kNm);
    const EnviHeader misspelt = parsed("wavelengths = {450,550.5,650}\nwavelength_unts = nm\n");
    EXPECT_EQ(misspelt.wavelengths_nm, kNm);
    EXPECT_TRUE(says(misspelt, "\"wavelengths\" is taken as \"wavelength\""));
    EXPECT_TRUE(says(misspelt, "\"wavelength_unts\" is taken as \"wavelength units\""));
    const EnviHeader odd = parsed("what is this\nfps = 3\nfps = 4\n");
    EXPECT_TRUE(says(odd, "line 7: found \"what is this\""));
    EXPECT_TRUE(says(odd, "line 9: \"fps\" comes a second time"));
    EXPECT_EQ(odd.fields.find("fps")->value, "4");
    const EnviHeader zeros = parsed("wavelength units = nm\nwavelength = {0, 550.5, 650}\n");
    EXPECT_EQ(zeros.wavelengths_nm[0], 0);
    EXPECT_TRUE(says(zeros, "1 of 3 bands have no wavelength"));
}

TEST(EnviHeader, WidthsAndBadBandsGoWithTheBands) {
    const EnviHeader header = parsed(
        "wavelength units = um\nwavelength = {0.45,0.5505,0.65}\nfwhm = {0.005,0.01,0.02}\nbbl = {1,0,1}\n");
    EXPECT_EQ(header.fwhm_nm, (std::vector<double>{5, 10, 20}));
    EXPECT_EQ(header.bad, (std::vector<bool>{false, true, false}));
    EXPECT_TRUE(says(header, "1 of 3 bands are bad"));
    // dl = l dv / v: 0.01 of the wavenumber is 0.01 of the wavelength.
    const EnviHeader reciprocal = parsed("wavelength units = Wavenumber\nwavelength = {20000,18000,16000}\n"
                                         "fwhm = {200,180,160}\n");
    EXPECT_NEAR(reciprocal.fwhm_nm[0], 5, 1e-12);
}

TEST(EnviHeader, WhatTheNumbersAreIsReadOrAssumedAloud) {
    EXPECT_EQ(parsed("reflectance scale factor = 100\n").quantity, Quantity::Reflectance);
    EXPECT_FALSE(says(parsed("reflectance scale factor = 100\n"), "taken as reflectance"));
    const EnviHeader radiance = parsed("data units = Radiance (uW/cm2/sr/nm)\n");
    EXPECT_EQ(radiance.quantity, Quantity::Radiance);
    EXPECT_EQ(radiance.units, "Radiance (uW/cm2/sr/nm)");
    EXPECT_FALSE(says(parsed("description = {surface Reflectance}\n"), "taken as reflectance"));
    EXPECT_EQ(parsed("description = {reflectance from radiance}\n").quantity, Quantity::Reflectance);
    EXPECT_TRUE(says(parsed("description = {reflectance from radiance}\n"), "taken as reflectance"));
    EXPECT_TRUE(says(parsed(""), "quantity=radiance makes them radiance"));
}

TEST(EnviHeader, TheUsersWordsSayWhatTheHeaderDoesNot) {
    const auto bands = parse_header(header_with(""))->bands;
    const std::string range = "500:1:" + std::to_string(499 + bands);
    const OpenWords words{parse_band_steps(range).value(), Quantity::Radiance};
    const auto header = parse_header(header_with(""), words);
    ASSERT_TRUE(header) << header.error().text();
    EXPECT_EQ(header->wavelengths_nm, words.wavelengths->steps_nm);
    EXPECT_EQ(header->quantity, Quantity::Radiance);
    EXPECT_FALSE(says(*header, "taken as"));
    const OpenWords table{parse_band_table("band.2,600,20", "bands.csv").value(), std::nullopt};
    const auto one = parse_header(header_with("fwhm = {1}\n"), table);
    ASSERT_TRUE(one) << one.error().text();
    EXPECT_EQ(one->wavelengths_nm.at(0), 0);
    EXPECT_EQ(one->wavelengths_nm.at(1), 600);
    EXPECT_EQ(one->fwhm_nm.at(1), 20);
    for (const std::string lines : {"data units = Reflectance\n", "reflectance scale factor = 10\n"}) {
        const auto refused = parse_header(header_with(lines), words);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::Contradiction);
        EXPECT_NE(refused.error().text().find("quantity=radiance does not fit: the header"),
                  std::string::npos);
    }
    const auto few = parse_header(header_with(""), {parse_band_steps("500:1:500").value(), std::nullopt});
    ASSERT_FALSE(few);
    EXPECT_EQ(few.error().code, ErrorCode::Contradiction);
}

TEST(EnviHeader, RefusalsSayWhatWasFoundAndWhatWasExpected) {
    EXPECT_NE(refusal("#?RADIANCE\n", ErrorCode::NotSpectral).find("first line is not ENVI"),
              std::string::npos);
    EXPECT_NE(refusal("NROWS 4\nNCOLS 5\n", ErrorCode::NotSpectral).find("no ENVI header"),
              std::string::npos);
    for (const std::string key : {"samples", "lines", "bands", "data type", "interleave"}) {
        std::string text = header_with("");
        const auto at = text.find(key + " =");
        text.erase(at, text.find('\n', at) - at);
        EXPECT_NE(refusal(text, ErrorCode::Damaged).find("lacks \"" + key + "\""), std::string::npos);
    }
    const auto replaced = [](const std::string& from, const std::string& to) {
        std::string text = header_with("");
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_NE(refusal(replaced("type = 12", "type = 6"), ErrorCode::Unsupported).find("complex"),
              std::string::npos);
    EXPECT_NE(refusal(replaced("type = 12", "type = 9"), ErrorCode::Unsupported).find("complex"),
              std::string::npos);
    EXPECT_NE(refusal(replaced("type = 12", "type = 7"), ErrorCode::Damaged).find("expected 1, 2, 3"),
              std::string::npos);
    EXPECT_NE(refusal(replaced("bil", "tiled"), ErrorCode::Damaged).find("expected bsq"), std::string::npos);
    for (const std::string bad : {"0", "-4", "4.5", "four", "99999999999999999999"})
        EXPECT_NE(
            refusal(replaced("samples = 4", "samples = " + bad), ErrorCode::Damaged).find("expected a count"),
            std::string::npos)
            << bad;
    EXPECT_NE(refusal(header_with("byte order = 2\n"), ErrorCode::Damaged).find("0 (little"),
              std::string::npos);
    EXPECT_NE(refusal(header_with("wavelength = {450, 550}\n"), ErrorCode::Damaged)
                  .find("2 items of \"wavelength\" for 3"),
              std::string::npos);
    EXPECT_NE(refusal(header_with("wavelength = {450, x, 650}\n"), ErrorCode::Damaged).find("found \"x\""),
              std::string::npos);
    EXPECT_NE(refusal(header_with("bbl = {1, 1}\n"), ErrorCode::Damaged).find("items of \"bbl\""),
              std::string::npos);
    EXPECT_NE(refusal(header_with("wavelength = {450,\n550"), ErrorCode::Damaged).find("never closed"),
              std::string::npos);
    EXPECT_NE(refusal(header_with("reflectance scale factor = 0\n"), ErrorCode::Damaged).find("above 0"),
              std::string::npos);
    EXPECT_NE(
        refusal(header_with("file type = ENVI Spectral Library\n"), ErrorCode::Unsupported).find("library"),
        std::string::npos);
    EXPECT_NE(refusal(header_with("file compression = 1\n"), ErrorCode::Unsupported).find("unpack"),
              std::string::npos);
    EXPECT_NE(refusal(header_with("major frame offsets = {0, 8}\n"), ErrorCode::Unsupported).find("frames"),
              std::string::npos);
}

TEST(EnviHeader, SizesThatOverflowAreRefused) {
    const auto sized = [](const std::string& samples, const std::string& lines, const std::string& bands) {
        return "ENVI\nsamples = " + samples + "\nlines = " + lines + "\nbands = " + bands +
               "\ndata type = 5\ninterleave = bsq\n";
    };
    // 2^30 x 2^30 x 2^16 x 8 bytes are 2^79.
    EXPECT_NE(refusal(sized("1073741823", "1073741823", "65536"), ErrorCode::Damaged).find("pixels"),
              std::string::npos);
    EXPECT_NE(refusal(sized("4294967297", "1", "1"), ErrorCode::Damaged).find("samples"), std::string::npos);
    EXPECT_NE(refusal(sized("1", "1", "65537"), ErrorCode::Damaged).find("bands"), std::string::npos);
    EXPECT_NE(refusal(sized("1", "1", "1") + "header offset = 18446744073709551615\n", ErrorCode::Damaged)
                  .find("before the data"),
              std::string::npos);
}

}  // namespace
}  // namespace osio::envi
