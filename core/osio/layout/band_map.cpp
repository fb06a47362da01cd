// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/band_map.h>
#include <osio/spectra/decimal_nm.h>
#include <osio/spectra/wavelength.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace osio {

namespace {

/// As many as a file may have channels.
constexpr double kMostSteps = 65536;

/// How far END may be from a step, in steps.
constexpr double kStepTolerance = 1e-3;

/// Names that an error spells out.
constexpr std::size_t kNamesInError = 4;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_number(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

tl::unexpected<Error> no_range(std::string_view text, std::string_view why) {
    return fail(ErrorCode::Usage, "wavelengths=" + std::string(text.substr(0, 80)) + " " + std::string(why) +
                                      "; expected START:STEP:END such as 400:10:700 or 0.4:0.01:0.7um, or a "
                                      ".csv of lines channel,nm");
}

/// A length in nm: a number with a unit, or a bare one in `unit`.
std::optional<double> length_nm(std::string_view text, std::string_view unit) {
    const std::string spelt = parse_double(text) ? std::string(text) + std::string(unit) : std::string(text);
    if (spelt.ends_with("Hz"))
        return std::nullopt;
    return parse_wavelength_nm(spelt, DecimalMark::Point);
}

/// What follows the number of a text: its unit.
std::string_view unit_behind(std::string_view text) {
    const auto last = text.find_last_of("0123456789.");
    return last == std::string_view::npos ? text : text.substr(last + 1);
}

/// "b9_x" before "b10_a": runs of digits as numbers, all else as bytes.
bool numeric_less(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        if (is_digit(a.front()) && is_digit(b.front())) {
            const auto take = [](std::string_view& text) {
                text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
                const std::string_view digits =
                    text.substr(0, std::min(text.find_first_not_of("0123456789"), text.size()));
                text.remove_prefix(digits.size());
                return digits;
            };
            const std::string_view left = take(a), right = take(b);
            if (left.size() != right.size())
                return left.size() < right.size();
            if (left != right)
                return left < right;
        } else {
            if (a.front() != b.front())
                return a.front() < b.front();
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    return a.size() < b.size();
}

std::vector<std::size_t> channels_in_order(std::span<const std::string> names) {
    std::vector<std::size_t> out;
    const bool numbered = std::count_if(names.begin(), names.end(), is_number) >= 2;
    for (std::size_t channel = 0; channel < names.size(); ++channel)
        if (numbered ? is_number(names[channel]) : !is_colour_or_depth(names[channel]))
            out.push_back(channel);
    std::stable_sort(out.begin(), out.end(),
                     [&](std::size_t a, std::size_t b) { return numeric_less(names[a], names[b]); });
    return out;
}

/// The fields of a line; a field in double quotes may hold the separator.
std::vector<std::string> fields_of(std::string_view line) {
    char separator = ',';
    bool quoted = false;
    for (const char c : line) {
        quoted = quoted != (c == '"');
        if (!quoted && (c == ';' || c == '\t'))
            separator = c;
    }
    std::vector<std::string> out{{}};
    quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == separator && !quoted)
            out.emplace_back();
        else
            out.back() += c;
    }
    for (std::string& field : out)
        field = trim(field);
    return out;
}

Result<MappedChannel> channel_of(const std::vector<std::string>& fields) {
    if (fields.size() < 2 || fields.size() > 3)
        return fail(ErrorCode::Usage, "has " + std::to_string(fields.size()) +
                                          " columns, expected channel,nm or channel,nm,fwhm");
    MappedChannel out{fields[0], 0, std::nullopt};
    const auto nm = length_nm(fields[1], "nm");
    if (!nm)
        return fail(ErrorCode::Usage,
                    "found \"" + fields[1].substr(0, 40) + "\", expected a wavelength in nm");
    out.wavelength_nm = *nm;
    if (fields.size() == 3 && !fields[2].empty()) {
        out.fwhm_nm = length_nm(fields[2], "nm");
        if (!out.fwhm_nm)
            return fail(ErrorCode::Usage,
                        "found \"" + fields[2].substr(0, 40) + "\", expected a width at half maximum in nm");
    }
    return out;
}

/// Refuses what a table has said before.
class Seen {
  public:
    [[nodiscard]] Result<void> add(const MappedChannel& channel) {
        if (!m_channels.insert(channel.channel).second)
            return fail(ErrorCode::Usage, "names the channel \"" + channel.channel + "\" for a second time");
        const auto [other, is_new] = m_by_wavelength.emplace(channel.wavelength_nm, channel.channel);
        if (!is_new)
            return fail(ErrorCode::Usage, "gives \"" + channel.channel + "\" the wavelength of \"" +
                                              other->second + "\", " + format_double(channel.wavelength_nm) +
                                              " nm");
        return {};
    }

  private:
    std::set<std::string> m_channels;
    std::map<double, std::string> m_by_wavelength;
};

tl::unexpected<Error> does_not_fit(const BandMap& map, std::span<const std::string> names,
                                   const std::vector<std::size_t>& channels) {
    std::string listed;
    for (std::size_t i = 0; i < std::min(channels.size(), kNamesInError); ++i)
        listed += (i ? ", \"" : " (\"") + names[channels[i]] + "\"";
    if (!channels.empty())
        listed += channels.size() > kNamesInError ? ", ...)" : ")";
    return fail(ErrorCode::Contradiction,
                "wavelengths=" + map.words + " are " + std::to_string(map.steps_nm.size()) +
                    " wavelengths, and there are " + std::to_string(channels.size()) +
                    " channels to give them to" + listed +
                    "; a .csv of lines channel,nm says which channels are bands");
}

}  // namespace

Result<BandMap> parse_band_steps(std::string_view text) {
    const auto pieces = split(text, ':');
    if (pieces.size() != 3)
        return no_range(text, "has " + std::to_string(pieces.size()) + " numbers");
    const std::string_view unit = unit_behind(trim(pieces[2]));
    std::array<double, 3> nm{};
    for (std::size_t i = 0; i < nm.size(); ++i) {
        const auto length = length_nm(trim(pieces[i]), unit.empty() ? "nm" : unit);
        if (!length)
            return no_range(text,
                            "holds \"" + std::string(pieces[i].substr(0, 40)) + "\", no length above 0");
        nm[i] = *length;
    }
    const auto [first, step, last] = nm;
    if (last < first)
        return no_range(text, "ends below its start");
    const double steps = (last - first) / step;
    if (!(steps < kMostSteps))
        return no_range(text, "are more wavelengths than a file has channels, 65536");
    if (std::abs(steps - std::round(steps)) > kStepTolerance)
        return no_range(text, "does not end on a step: " + format_double(decimal_nm(first)) + " nm plus " +
                                  std::to_string(static_cast<int>(steps)) + " steps are " +
                                  format_double(decimal_nm(first + step * std::floor(steps))) + " nm");
    BandMap out{std::string(text), {}, {}};
    for (int i = 0; i <= static_cast<int>(std::lround(steps)); ++i)
        out.steps_nm.push_back(decimal_nm(first + step * i));
    for (std::size_t i = 1; i < out.steps_nm.size(); ++i)
        if (out.steps_nm[i] <= out.steps_nm[i - 1])
            return no_range(text, "has steps that are too small");
    return out;
}

Result<BandMap> parse_band_table(std::string_view csv, std::string words) {
    BandMap out{std::move(words), {}, {}};
    int number = 0;
    bool header_allowed = true;
    Seen seen;
    for (const std::string_view raw : split(csv, '\n')) {
        ++number;
        const std::string_view line = trim(raw);
        if (line.empty() || line.front() == '#')
            continue;
        const std::string where = out.words + ": line " + std::to_string(number);
        const auto fields = fields_of(line);
        const bool header =
            header_allowed && fields.size() > 1 && std::none_of(fields[1].begin(), fields[1].end(), is_digit);
        header_allowed = false;
        if (header)
            continue;
        auto channel = channel_of(fields);
        if (!channel)
            return fail_in(where, std::move(channel).error());
        if (auto added = seen.add(*channel); !added)
            return fail_in(where, std::move(added).error());
        out.channels.push_back(std::move(*channel));
    }
    if (out.channels.empty())
        return fail(ErrorCode::Usage, "holds no line channel,nm", out.words);
    return out;
}

bool is_colour_or_depth(std::string_view channel_name) {
    constexpr std::string_view kNames = "RGBAZ";
    const auto dot = channel_name.rfind('.');
    const std::string_view last = channel_name.substr(dot == std::string_view::npos ? 0 : dot + 1);
    return last.size() == 1 && kNames.find(last) != std::string_view::npos;
}

Result<std::vector<std::optional<MappedBand>>> map_bands(const BandMap& map,
                                                         std::span<const std::string> channel_names) {
    std::vector<std::optional<MappedBand>> out(channel_names.size());
    if (!map.steps_nm.empty()) {
        const auto channels = channels_in_order(channel_names);
        if (channels.size() != map.steps_nm.size())
            return does_not_fit(map, channel_names, channels);
        for (std::size_t i = 0; i < channels.size(); ++i)
            out[channels[i]] = MappedBand{map.steps_nm[i], std::nullopt};
        return out;
    }
    std::map<std::string_view, std::size_t> index;
    for (std::size_t channel = 0; channel < channel_names.size(); ++channel)
        index.emplace(channel_names[channel], channel);
    for (const MappedChannel& channel : map.channels) {
        const auto found = index.find(channel.channel);
        if (found == index.end())
            return fail(ErrorCode::Contradiction,
                        "names the channel \"" + channel.channel + "\", which the file does not have" +
                            suggestion(channel.channel, channel_names),
                        map.words);
        out[found->second] = MappedBand{channel.wavelength_nm, channel.fwhm_nm};
    }
    return out;
}

}  // namespace osio
