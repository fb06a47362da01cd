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

/// The fields of a line: at the first kind of separator that occurs in it; runs of spaces count as one.
std::vector<std::string_view> fields_of(std::string_view line) {
    char separator = 0;
    for (const char candidate : {';', '\t', ',', ' '})
        if (separator == 0 && line.find(candidate) != std::string_view::npos)
            separator = candidate;
    if (separator == 0)
        return {line};
    std::vector<std::string_view> out;
    for (const std::string_view field : split(line, separator))
        if (separator != ' ' || !field.empty())
            out.push_back(trim(field));
    return out;
}

/// The numbers of a line's fields; nothing for those that are none.
std::vector<std::optional<double>> numbers_of(const std::vector<std::string_view>& fields) {
    std::vector<std::optional<double>> out;
    for (const std::string_view field : fields)
        out.push_back(parse_double(field));
    return out;
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

double Spectrum::held_at(double wavelength_nm) const {
    return linear_at(std::clamp(wavelength_nm, wavelengths_nm.front(), wavelengths_nm.back()));
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

std::string format_spectrum_text(const Spectrum& spectrum) {
    std::string out, sample;
    for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
        sample = format_wavelength(spectrum.wavelengths_nm[i], DecimalMark::Point) + ":" +
                 format_double(spectrum.values[i]);
        out += sample + ";";
    }
    return out + sample;
}

Result<Spectrum> parse_spectrum_csv(std::string_view text) {
    OSIO_TRY(std::vector<Spectrum> curves, parse_curves_csv(text, 1));
    return std::move(curves.front());
}

Result<std::vector<Spectrum>> parse_curves_csv(std::string_view text, std::size_t count) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark))
        text.remove_prefix(kByteOrderMark.size());

    std::vector<double> wavelengths_nm;
    std::vector<std::vector<double>> values(count);
    bool header_allowed = true;
    std::size_t number = 0;
    for (const std::string_view raw : split(text, '\n')) {
        ++number;
        const std::string_view line = trim(raw);
        if (line.empty() || line.starts_with('#'))
            continue;
        const auto fields = numbers_of(fields_of(line));
        const auto is_number = [](const std::optional<double>& field) { return field.has_value(); };
        const bool header = header_allowed && std::none_of(fields.begin(), fields.end(), is_number);
        header_allowed = false;
        if (header)
            continue;
        if (fields.size() != count + 1 || !std::all_of(fields.begin(), fields.end(), is_number))
            return bad_line(number, "found \"" + std::string(line.substr(0, 60)) + "\", expected " +
                                        (count == 1 ? "two numbers: wavelength in nm, value"
                                                    : std::to_string(count + 1) +
                                                          " numbers: wavelength in nm, then " +
                                                          std::to_string(count) + " values"));
        const double nm = *fields[0];
        if (nm <= 0)
            return bad_line(number, "a wavelength of " + format_double(nm) + " nm is not positive");
        if (!wavelengths_nm.empty() && nm <= wavelengths_nm.back())
            return bad_line(number, format_double(nm) + " nm follows " +
                                        format_double(wavelengths_nm.back()) +
                                        " nm; wavelengths must increase from line to line");
        wavelengths_nm.push_back(nm);
        for (std::size_t c = 0; c < count; ++c)
            values[c].push_back(*fields[c + 1]);
    }
    if (wavelengths_nm.empty())
        return fail(ErrorCode::Usage, "no line with a wavelength in nm and a value");
    if (wavelengths_nm.back() < kSmallestPlausibleLastNm)
        return fail(ErrorCode::Usage, "the wavelengths end at " + format_double(wavelengths_nm.back()) +
                                          ": these look like micrometres; nanometres are expected");
    std::vector<Spectrum> out;
    for (std::vector<double>& column : values)
        out.push_back({wavelengths_nm, std::move(column)});
    return out;
}

}  // namespace osio
