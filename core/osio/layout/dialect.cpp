// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/band_map.h>
#include <osio/layout/bin_dialects.h>
#include <osio/layout/dialect.h>
#include <osio/spectra/decimal_nm.h>
#include <osio/spectra/wavelength_unit.h>

#include <algorithm>
#include <array>
#include <set>

namespace osio {

namespace {

using Names = std::span<const std::string>;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// The number that is all that follows `prefix`; nothing where the name is another.
std::optional<int> number_behind(std::string_view name, std::string_view prefix) {
    if (!name.starts_with(prefix))
        return std::nullopt;
    name.remove_prefix(prefix.size());
    if (!std::all_of(name.begin(), name.end(), is_digit))
        return std::nullopt;
    return parse_int(name);
}

/// A reading in the making: bands are added channel by channel.
class Reading {
  public:
    Reading(Names names, std::string dialect, std::optional<Quantity> quantity) : m_names(names) {
        m_out.dialect.name = std::move(dialect);
        m_out.quantity = quantity;
        m_out.bands.resize(names.size());
    }

    void add(std::size_t channel, double nm, std::string root = {}) {
        m_out.bands[channel] = ChannelName{std::move(root), family(), nm, std::nullopt};
        m_first = m_count++ == 0 ? channel : m_first;
    }

    [[nodiscard]] std::size_t count() const { return m_count; }

    DialectReading* operator->() { return &m_out; }

    /// Nothing for fewer than two bands. `evidence` follows the number of names and the first.
    std::optional<DialectReading> done(const std::string& evidence = {}) {
        if (m_count < 2)
            return std::nullopt;
        m_out.dialect.evidence =
            std::to_string(m_count) + " names such as \"" + m_names[m_first] + "\"" + evidence;
        return std::move(m_out);
    }

  private:
    [[nodiscard]] Family family() const {
        return m_out.quantity == Quantity::Radiance ? Family::S0 : Family::T;
    }

    Names m_names;
    DialectReading m_out;
    std::size_t m_count = 0;
    std::size_t m_first = 0;
};

/// Ocean states the wavelength of any channel in metres, as an attribute.
std::optional<DialectReading> read_ocean(Names names, const HeaderAttributes& header) {
    constexpr std::string_view kEnding = ".wavelength";
    Reading out(names, "Ocean channels", std::nullopt);
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        const std::string attribute = names[channel] + std::string(kEnding);
        const auto found = header.numbers.find(attribute);
        const double nm = found == header.numbers.end() ? 0 : nm_of(found->second, "m");
        if (nm <= 0)
            continue;
        out.add(channel, decimal_nm(nm));
        out->dialect.attributes.push_back(attribute);
    }
    return out.done(" with an attribute .wavelength in metres");
}

/// ISET3D's fork of pbrt numbers its bands: 400 nm and on every 10 nm.
std::optional<DialectReading> read_iset(Names names) {
    constexpr std::size_t kUsual = 31;
    Reading out(names, "ISET3D bands", Quantity::Radiance);
    for (std::size_t channel = 0; channel < names.size(); ++channel)
        if (const auto number = number_behind(names[channel], "Radiance.C"); number && *number >= 1)
            out.add(channel, 400 + 10 * (static_cast<double>(*number) - 1));
    if (out.count() != kUsual)
        out->warnings.push_back(
            std::to_string(out.count()) +
            " bands of ISET3D, which usually writes 31: they are taken to start at 400 nm and "
            "lie 10 nm apart; wavelengths= says otherwise");
    return out.done(", which are 400 nm and on every 10 nm");
}

/// GDAL keeps what ENVI called a band as text.
std::optional<DialectReading> read_gdal(Names names, const HeaderAttributes& header) {
    constexpr std::string_view kPrefix = "gdal:Band_";
    const auto gdal = header.texts.lower_bound("gdal:");
    if (gdal == header.texts.end() || !gdal->first.starts_with("gdal:"))
        return std::nullopt;
    Reading out(names, "GDAL bands", std::nullopt);
    std::size_t bands = 0;
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        const auto number = number_behind(names[channel], "Band");
        if (!number)
            continue;
        ++bands;
        const std::string attribute = std::string(kPrefix) + std::to_string(*number);
        const auto found = header.texts.find(attribute);
        const auto nm = found == header.texts.end() ? std::vector<double>() : wavelengths_in(found->second);
        if (nm.size() != 1)
            continue;
        out.add(channel, nm.front());
        out->dialect.attributes.push_back(attribute);
    }
    if (bands < 2)
        return std::nullopt;
    if (out.count() < bands)
        out->warnings.push_back(std::to_string(bands - out.count()) + " of " + std::to_string(bands) +
                                " bands have no wavelength in an attribute gdal:Band_N and are left out");
    if (auto found = out.done(" with a wavelength in gdal:Band_N"))
        return found;
    DialectReading none;
    none.bands.resize(names.size());
    none.dialect = {"GDAL bands", "names Band1 and on, attributes gdal:", {}};
    return none;
}

/// Mitsuba 3's specfilm names channels by its own parameters, and writes responses nowhere.
std::optional<DialectReading> read_mitsuba3(Names names, const HeaderAttributes& header) {
    const auto by = header.texts.find("generatedBy");
    const auto is_colour = [](const std::string& name) {
        constexpr std::array<std::string_view, 6> kColours{"R", "G", "B", "X", "Y", "Z"};
        const std::string_view last = std::string_view(name).substr(name.rfind('.') + 1);
        return std::find(kColours.begin(), kColours.end(), last) != kColours.end();
    };
    if (by == header.texts.end() || !by->second.starts_with("Mitsuba version 3") || names.size() < 2 ||
        std::any_of(names.begin(), names.end(), is_colour))
        return std::nullopt;
    DialectReading out;
    out.bands.resize(names.size());
    out.quantity = Quantity::Radiance;
    out.dialect = {"Mitsuba 3 film bands", "generatedBy \"" + by->second.substr(0, 40) + "\"", {}};
    return out;
}

/// OpenCV calls channels 0 to N - 1.
std::optional<DialectReading> read_opencv(Names names) {
    std::set<int> numbers;
    for (const std::string& name : names)
        if (const auto number = number_behind(name, ""))
            numbers.insert(*number);
    if (names.size() < 2 || numbers.size() != names.size() || *numbers.begin() != 0 ||
        *numbers.rbegin() != static_cast<int>(names.size()) - 1)
        return std::nullopt;
    DialectReading out;
    out.bands.resize(names.size());
    out.dialect = {"OpenCV's numbered channels", "names 0 to " + std::to_string(names.size() - 1), {}};
    return out;
}

/// Decimal commas as points, and a point behind a word and its number as what it is, the end of a layer's
/// name: band1.550nm is 550 nm.
std::string with_clear_marks(std::string name) {
    for (std::size_t i = 1; i + 1 < name.size(); ++i) {
        if (!is_digit(name[i - 1]) || !is_digit(name[i + 1]))
            continue;
        std::size_t start = i;
        while (start > 0 && is_digit(name[start - 1]))
            --start;
        const char before = start == 0 ? '\0' : name[start - 1];
        const bool word = (before >= 'a' && before <= 'z') || (before >= 'A' && before <= 'Z');
        if (name[i] == ',')
            name[i] = '.';
        else if (name[i] == '.' && word)
            name[i] = '/';
    }
    return name;
}

/// 395-405nm is a bin: its end is no wavelength.
bool holds_a_range(std::string_view name) {
    for (std::size_t i = 1; i + 1 < name.size(); ++i)
        if (name[i] == '-' && is_digit(name[i - 1]) && is_digit(name[i + 1]))
            return true;
    return false;
}

/// The layer in front of the part of a name that holds its wavelength.
std::string layer_of(const std::string& name) {
    const std::string clear = with_clear_marks(name);
    std::size_t dot = std::string::npos;
    for (std::size_t i = 0; i < clear.size(); ++i)
        if (clear[i] == '/' || (clear[i] == '.' && (i == 0 || i + 1 == clear.size() ||
                                                    !is_digit(clear[i - 1]) || !is_digit(clear[i + 1]))))
            dot = i;
    return dot == std::string::npos ? std::string() : name.substr(0, dot);
}

/// Every name but R, G, B, A and Z holds one wavelength.
std::optional<DialectReading> read_wavelengths(Names names) {
    Reading out(names, "wavelengths in names", std::nullopt);
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        const std::string& name = names[channel];
        if (is_colour_or_depth(name))
            continue;
        const auto nm = wavelengths_in(with_clear_marks(name));
        if (nm.size() != 1 || holds_a_range(name) || looks_like_a_band(name))
            return std::nullopt;
        out.add(channel, nm.front(), layer_of(name));
    }
    return out.done(", each with one wavelength");
}

}  // namespace

std::optional<DialectReading> read_dialect(Names channel_names, const HeaderAttributes& header) {
    if (auto out = read_ocean(channel_names, header))
        return out;
    if (auto out = read_mitsuba_bins(channel_names)) {
        for (const char* key : {"generated-by", "generatedBy"})
            if (const auto by = header.texts.find(key); by != header.texts.end())
                out->dialect.evidence += "; " + std::string(key) + " \"" + by->second.substr(0, 40) + "\"";
        return out;
    }
    if (auto out = read_indigo_buckets(channel_names))
        return out;
    if (auto out = read_iset(channel_names))
        return out;
    if (auto out = read_gdal(channel_names, header))
        return out;
    if (auto out = read_mitsuba3(channel_names, header))
        return out;
    if (auto out = read_opencv(channel_names))
        return out;
    return read_wavelengths(channel_names);
}

}  // namespace osio
