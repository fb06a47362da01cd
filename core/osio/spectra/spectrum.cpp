// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/spectra/spectrum.h>
#include <osio/spectra/wavelength.h>

#include <algorithm>
#include <map>

namespace osio {

namespace {

/// A wavelength column that ends below this was most likely meant in micrometres.
constexpr double kSmallestPlausibleLastNm = 10.0;

std::optional<double> parse_either_mark(std::string_view text) {
    std::string pointed(text);
    std::replace(pointed.begin(), pointed.end(), ',', '.');
    return parse_double(pointed);
}

/// The two fields of a line, split at the first separator that occurs in it.
std::pair<std::string_view, std::string_view> two_fields(std::string_view line) {
    for (const char separator : {';', '\t', ',', ' '}) {
        const auto at = line.find(separator);
        if (at != std::string_view::npos)
            return {trim(line.substr(0, at)), trim(line.substr(at + 1))};
    }
    return {line, {}};
}

tl::unexpected<Error> bad_line(std::size_t number, std::string what) {
    return fail(ErrorCode::Usage, std::move(what), "line " + std::to_string(number));
}

}  // namespace

double Spectrum::linear_at(double wavelength_nm) const {
    const auto above = std::lower_bound(wavelengths_nm.begin(), wavelengths_nm.end(), wavelength_nm);
    if (above == wavelengths_nm.end())
        return 0;
    const auto i = static_cast<std::size_t>(above - wavelengths_nm.begin());
    if (*above == wavelength_nm)
        return values[i];
    if (i == 0)
        return 0;
    const double lo = wavelengths_nm[i - 1];
    const double t = (wavelength_nm - lo) / (*above - lo);
    return values[i - 1] + t * (values[i] - values[i - 1]);
}

SpectrumText parse_spectrum_text(std::string_view text) {
    SpectrumText out;
    std::map<double, double> samples;
    for (const std::string_view piece : split(text, ';')) {
        const std::string_view sample = trim(piece);
        if (sample.empty())
            continue;
        const auto colon = sample.find(':');
        std::string abscissa(trim(sample.substr(0, colon)));
        std::erase(abscissa, ' ');  // "400 nm" is found in files
        const auto nm = parse_wavelength_nm(abscissa, DecimalMark::Either);
        const auto value = colon == std::string_view::npos
                               ? std::nullopt
                               : parse_either_mark(trim(sample.substr(colon + 1)));
        if (nm && value)
            samples.emplace(*nm, *value);
        else
            out.rejected.emplace_back(sample);
    }
    for (const auto& [nm, value] : samples) {
        out.spectrum.wavelengths_nm.push_back(nm);
        out.spectrum.values.push_back(value);
    }
    return out;
}

Result<Spectrum> parse_spectrum_csv(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark))
        text.remove_prefix(kByteOrderMark.size());

    Spectrum out;
    bool header_allowed = true;
    std::size_t number = 0;
    for (const std::string_view raw : split(text, '\n')) {
        ++number;
        const std::string_view line = trim(raw);
        if (line.empty() || line.starts_with('#'))
            continue;
        const auto [first, second] = two_fields(line);
        const auto nm = parse_double(first);
        const auto value = parse_double(second);
        const bool header = header_allowed && !nm && !value;
        header_allowed = false;
        if (header)
            continue;
        if (!nm || !value)
            return bad_line(number, "found \"" + std::string(line.substr(0, 60)) +
                                        "\", expected two numbers: wavelength in nm, value");
        if (*nm <= 0)
            return bad_line(number, "a wavelength of " + format_double(*nm) + " nm is not positive");
        if (!out.wavelengths_nm.empty() && *nm <= out.wavelengths_nm.back())
            return bad_line(number, format_double(*nm) + " nm follows " +
                                        format_double(out.wavelengths_nm.back()) +
                                        " nm; wavelengths must increase from line to line");
        out.wavelengths_nm.push_back(*nm);
        out.values.push_back(*value);
    }
    if (out.wavelengths_nm.empty())
        return fail(ErrorCode::Usage, "no line with a wavelength in nm and a value");
    if (out.wavelengths_nm.back() < kSmallestPlausibleLastNm)
        return fail(ErrorCode::Usage, "the wavelengths end at " + format_double(out.wavelengths_nm.back()) +
                                          ": these look like micrometres; nanometres are expected");
    return out;
}

}  // namespace osio
