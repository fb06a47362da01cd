// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/wavelength_unit.h>

#include <gtest/gtest.h>

namespace osio {
namespace {

using Found = std::vector<double>;

TEST(WavelengthUnit, WordsOfFilesAreFoundInAnySpelling) {
    EXPECT_EQ(find_wavelength_unit("Nanometers"), "nm");
    EXPECT_EQ(find_wavelength_unit(" MICRONS "), "um");
    EXPECT_EQ(find_wavelength_unit("\xC2\xB5m"), "um");
    EXPECT_EQ(find_wavelength_unit("Wavenumber"), "cm-1");
    EXPECT_FALSE(find_wavelength_unit("Unknown"));
    EXPECT_FALSE(find_wavelength_unit(""));
}

TEST(WavelengthUnit, DecimalsAreScaledBeforeTheyAreRounded) {
    EXPECT_EQ(nm_of("0.55", "um"), 550);
    EXPECT_EQ(nm_of("+0.4182", "um"), 418.2);
    EXPECT_EQ(nm_of("20000", "cm-1"), 500);
    for (const char* none : {"0", "-1", "", "blue", "nan"})
        EXPECT_EQ(nm_of(none, "nm"), 0) << none;
}

TEST(WavelengthUnit, NumbersWithoutAUnitAreMicrometresBelowAHundred) {
    EXPECT_EQ(likely_unit(Found{0.4, 2.5}), "um");
    EXPECT_EQ(likely_unit(Found{0.4, 400}), "nm");
}

TEST(WavelengthUnit, WidthsOfFrequenciesAreShares) {
    EXPECT_EQ(width_nm(0.01, 0.5, 500, "um"), 10);
    EXPECT_EQ(width_nm(200, 20000, 500, "cm-1"), 5);
    EXPECT_EQ(width_nm(200, 0, 0, "THz"), 0);
}

TEST(WavelengthUnit, WavelengthsAreFoundInWords) {
    EXPECT_EQ(wavelengths_in("band 1 (418.24 Nanometers)"), Found{418.24});
    EXPECT_EQ(wavelengths_in("col_0500_nm"), Found{500});
    EXPECT_EQ(wavelengths_in("leaf_450nm"), Found{450});
    EXPECT_EQ(wavelengths_in("0.4182 um, 650-nm"), (Found{418.2, 650}));
    for (const char* none : {"IMG_0001_2", "12 bands", "nm", "5 nmea", "450", "3m", "9.nm5", ""})
        EXPECT_EQ(wavelengths_in(none), Found()) << none;
}

}  // namespace
}  // namespace osio
