// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/wavelength.h>

#include <gtest/gtest.h>

#include <clocale>
#include <random>
#include <string>

namespace osio {
namespace {

std::optional<double> nm(const char* text) {
    return parse_wavelength_nm(text, DecimalMark::Comma);
}

TEST(Wavelength, UnitsAndPrefixesOfTheLayout) {
    EXPECT_EQ(nm("550nm"), 550.0);
    EXPECT_EQ(nm("550,5nm"), 550.5);
    EXPECT_EQ(nm("550,nm"), 550.0);
    EXPECT_EQ(nm(",5um"), 500.0);
    EXPECT_EQ(nm("0,55um"), 550.0);
    EXPECT_EQ(nm("0,55\xC2\xB5m"), 550.0);
    EXPECT_EQ(nm("0,55\xCE\xBCm"), 550.0);
    EXPECT_EQ(nm("5,5e-7m"), 550.0);
    EXPECT_EQ(nm("5E2nm"), 500.0);
    EXPECT_EQ(nm("5500e+2pm"), 550.0);
    EXPECT_EQ(nm("0,2dam"), 2e9);
    EXPECT_EQ(nm("550000fm"), 0.55);
    EXPECT_EQ(nm("5Em"), 5e27);  // the prefix exa, not an exponent
    EXPECT_EQ(nm("1m"), 1e9);
    EXPECT_EQ(nm("1mm"), 1e6);
}

TEST(Wavelength, FrequenciesAreConvertedByTheSpeedOfLight) {
    EXPECT_NEAR(*nm("545THz"), 550.0779, 5e-5);
    EXPECT_DOUBLE_EQ(*nm("299792458Hz"), 1e9);
    EXPECT_DOUBLE_EQ(*nm("599584916MHz"), 299792458.0 / 599584916e6 * 1e9);
}

TEST(Wavelength, CommaIsTheDecimalMarkOfNamesAndPointOfOurOwn) {
    EXPECT_FALSE(nm("550.5nm"));
    EXPECT_EQ(parse_wavelength_nm("550.5nm", DecimalMark::Point), 550.5);
    EXPECT_FALSE(parse_wavelength_nm("550,5nm", DecimalMark::Point));
    EXPECT_EQ(parse_wavelength_nm("550,5nm", DecimalMark::Either), 550.5);
}

TEST(Wavelength, WhatIsNoQuantityIsRefused) {
    for (const char* bad : {"", "nm", "550", "550NM", "550 nm", "-550nm", "+550nm", "550nmx", "e5nm", ",nm",
                            "0nm", "0,0nm", "1e999nm", "550hz", "550Knm", "55..0nm", "5,5,5nm"})
        EXPECT_FALSE(nm(bad)) << bad;
}

TEST(Wavelength, EqualQuantitiesAreTheSameDoubleInEveryUnit) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> digits(1, 999999);
    for (int i = 0; i < 2000; ++i) {
        const int n = digits(random);  // thousandths of a nanometre
        const std::string whole = std::to_string(n / 1000);
        std::string fraction = std::to_string(n % 1000);
        fraction.insert(0, 3 - fraction.size(), '0');
        const auto in_nm = nm((whole + "," + fraction + "nm").c_str());
        EXPECT_EQ(in_nm, nm((std::to_string(n) + "pm").c_str()));
        EXPECT_EQ(in_nm, nm((std::to_string(n) + "e-12m").c_str()));
    }
}

TEST(Wavelength, FormattedWavelengthsReadBack) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> range(1e-3, 1e5);
    for (int i = 0; i < 5000; ++i) {
        const double value = range(random);
        for (const auto mark : {DecimalMark::Comma, DecimalMark::Point})
            EXPECT_EQ(parse_wavelength_nm(format_wavelength(value, mark), mark), value);
    }
    EXPECT_EQ(format_wavelength(450, DecimalMark::Comma), "450nm");
    EXPECT_EQ(format_wavelength(450.5, DecimalMark::Comma), "450,5nm");
}

TEST(Wavelength, LocaleDoesNotMatter) {
    const std::string old = std::setlocale(LC_ALL, nullptr);
    // Where no such locale is installed this sets nothing, and the test repeats what is known.
    std::setlocale(LC_ALL, "de_DE.UTF-8");
    EXPECT_EQ(nm("550,5nm"), 550.5);
    EXPECT_EQ(format_wavelength(450.5, DecimalMark::Point), "450.5nm");
    std::setlocale(LC_ALL, old.c_str());
}

}  // namespace
}  // namespace osio
