// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/spectra/wavelength.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace osio {

namespace {

struct Prefix {
    std::string_view text;
    int exponent;
};

/// SI prefixes; "da" stands before "d" so that the longer one is tried first.
constexpr std::array<Prefix, 23> kPrefixes{{
    {"Y", 24}, {"Z", 21},  {"E", 18},  {"P", 15},  {"T", 12},  {"G", 9},   {"M", 6},         {"k", 3},
    {"h", 2},  {"da", 1},  {"d", -1},  {"c", -2},  {"m", -3},  {"u", -6},  {"\xC2\xB5", -6}, {"\xCE\xBC", -6},
    {"n", -9}, {"p", -12}, {"f", -15}, {"a", -18}, {"z", -21}, {"y", -24}, {"", 0},
}};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_mark(char c, DecimalMark mark) {
    return (c == ',' && mark != DecimalMark::Point) || (c == '.' && mark != DecimalMark::Comma);
}

struct Decimal {
    std::string digits;  // digits with at most one point
    int exponent = 0;
};

std::size_t count_digits(std::string_view text) {
    return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
}

std::optional<Decimal> take_decimal(std::string_view& text, DecimalMark mark) {
    Decimal out;
    std::size_t at = count_digits(text);
    out.digits = text.substr(0, at);
    if (at < text.size() && is_mark(text[at], mark)) {
        const std::size_t fraction = count_digits(text.substr(at + 1));
        out.digits += '.';
        out.digits += text.substr(at + 1, fraction);
        at += 1 + fraction;
    }
    if (std::none_of(out.digits.begin(), out.digits.end(), is_digit))
        return std::nullopt;
    // An 'E' without digits behind it is the prefix exa.
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        std::size_t start = at + 1;
        const bool negative = start < text.size() && text[start] == '-';
        if (start < text.size() && (text[start] == '+' || text[start] == '-'))
            ++start;
        if (const std::size_t length = count_digits(text.substr(start))) {
            const auto exponent = parse_int(text.substr(start, length));
            if (!exponent || *exponent > 10000)
                return std::nullopt;
            out.exponent = negative ? -*exponent : *exponent;
            at = start + length;
        }
    }
    text.remove_prefix(at);
    return out;
}

/// The correctly rounded double of digits x 10^(exponent + shift).
std::optional<double> scaled(const Decimal& decimal, int shift) {
    return parse_double(decimal.digits + "e" + std::to_string(decimal.exponent + shift));
}

}  // namespace

std::optional<double> take_wavelength_nm(std::string_view& text, DecimalMark mark) {
    constexpr double kNmHz = kSpeedOfLightMPerS * 1e9;  // exact: 53 bits suffice
    std::string_view rest = text;
    const auto decimal = take_decimal(rest, mark);
    if (!decimal)
        return std::nullopt;
    for (const Prefix& prefix : kPrefixes) {
        if (!rest.starts_with(prefix.text))
            continue;
        const std::string_view unit = rest.substr(prefix.text.size());
        const bool metre = unit.starts_with('m');
        if (!metre && !unit.starts_with("Hz"))
            continue;
        const std::string_view after = unit.substr(metre ? 1 : 2);
        if (!after.empty() && after.front() != '.')
            continue;
        const auto value = scaled(*decimal, metre ? prefix.exponent + 9 : prefix.exponent);
        if (!value || *value <= 0)
            return std::nullopt;
        const double nm = metre ? *value : kNmHz / *value;
        if (nm > 1e300 || nm < 1e-300)
            return std::nullopt;
        text = after;
        return nm;
    }
    return std::nullopt;
}

std::optional<double> parse_wavelength_nm(std::string_view text, DecimalMark mark) {
    const auto nm = take_wavelength_nm(text, mark);
    return nm && text.empty() ? nm : std::nullopt;
}

std::string format_wavelength(double wavelength_nm, DecimalMark mark) {
    std::string out = format_double(wavelength_nm);
    if (mark == DecimalMark::Comma)
        std::replace(out.begin(), out.end(), '.', ',');
    return out + "nm";
}

}  // namespace osio
