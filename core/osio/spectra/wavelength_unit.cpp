// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/spectra/wavelength.h>
#include <osio/spectra/wavelength_unit.h>

#include <algorithm>
#include <array>
#include <string>

namespace osio {

namespace {

struct Spelling {
    std::string_view word;
    WavelengthUnit unit;
};

constexpr WavelengthUnit kWavenumber = "cm-1";

/// In lower case.
constexpr std::array<Spelling, 27> kSpellings{{
    {"nanometers", "nm"},   {"nanometer", "nm"},   {"nanometres", "nm"},
    {"nanometre", "nm"},    {"nm", "nm"},          {"micrometers", "um"},
    {"micrometer", "um"},   {"micrometres", "um"}, {"micrometre", "um"},
    {"microns", "um"},      {"micron", "um"},      {"um", "um"},
    {"\xC2\xB5m", "um"},    {"\xCE\xBCm", "um"},   {"\xB5m", "um"},
    {"millimeters", "mm"},  {"mm", "mm"},          {"centimeters", "cm"},
    {"cm", "cm"},           {"meters", "m"},       {"m", "m"},
    {"ghz", "GHz"},         {"mhz", "MHz"},        {"thz", "THz"},
    {"wavenumber", "cm-1"}, {"cm-1", "cm-1"},      {"1/cm", "cm-1"},
}};

constexpr double kLeastNm = 100;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_word(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The unit that `text` starts with, as a whole word; the longest, so that "nm" is not found in "nmea".
std::optional<WavelengthUnit> leading_unit(std::string_view text) {
    const std::string lower = to_lower(text);
    std::string_view longest;
    WavelengthUnit unit;
    for (const Spelling& spelling : kSpellings)
        if ((spelling.unit == "nm" || spelling.unit == "um" || spelling.unit == "THz") &&
            lower.starts_with(spelling.word) && spelling.word.size() > longest.size()) {
            longest = spelling.word;
            unit = spelling.unit;
        }
    if (longest.empty() || (longest.size() < text.size() && is_word(text[longest.size()])))
        return std::nullopt;
    return unit;
}

}  // namespace

std::optional<WavelengthUnit> find_wavelength_unit(std::string_view word) {
    const std::string lower = to_lower(trim(word));
    for (const Spelling& spelling : kSpellings)
        if (spelling.word == lower)
            return spelling.unit;
    return std::nullopt;
}

WavelengthUnit likely_unit(std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number < kLeastNm; })
               ? "um"
               : "nm";
}

double nm_of(std::string_view number, WavelengthUnit unit) {
    number = trim(number);
    const auto value = parse_double(number);
    if (!value || *value <= 0)
        return 0;
    if (unit == kWavenumber)
        return 1e7 / *value;
    if (number.starts_with('+'))
        number.remove_prefix(1);
    return parse_wavelength_nm(std::string(number) + std::string(unit), DecimalMark::Point).value_or(0);
}

double width_nm(double width, double centre, double centre_nm, WavelengthUnit unit) {
    const bool reciprocal = unit.ends_with("Hz") || unit == kWavenumber;
    if (reciprocal)
        return centre > 0 ? centre_nm * width / centre : 0;
    return nm_of(format_double(width), unit);
}

std::vector<double> wavelengths_in(std::string_view text) {
    std::vector<double> out;
    for (std::size_t at = 0; at < text.size();) {
        if (!is_digit(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        bool point = false;
        while (end < text.size() &&
               (is_digit(text[end]) ||
                (text[end] == '.' && !point && end + 1 < text.size() && is_digit(text[end + 1])))) {
            point = point || text[end] == '.';
            ++end;
        }
        std::string_view rest = text.substr(end);
        if (!rest.empty() && (rest[0] == ' ' || rest[0] == '_' || rest[0] == '-'))
            rest.remove_prefix(1);
        if (const auto unit = leading_unit(rest))
            if (const double nm = nm_of(text.substr(at, end - at), *unit); nm > 0)
                out.push_back(nm);
        at = end;
    }
    return out;
}

}  // namespace osio
