// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/channel_layout.h>

#include <algorithm>
#include <map>
#include <utility>

namespace osio {

namespace {

/// At most this many names are spelled out in one warning.
constexpr std::size_t kNamesInWarning = 3;

std::string quoted_list(const std::vector<std::string>& names) {
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), kNamesInWarning); ++i)
        out += (i ? ", \"" : "\"") + names[i] + "\"";
    if (names.size() > kNamesInWarning)
        out += " and " + std::to_string(names.size() - kNamesInWarning) + " more";
    return out;
}

/// The name of one of the layout's bands, for people.
const std::string& first_band(const ChannelLayout& layout) {
    const SpectralSet& set = layout.sets.front();
    return layout
        .channel_names[set.bands.empty() ? set.reradiation.front().channel : set.bands.front().channel];
}

void warn_of_duplicates(const SpectralSet& set, ChannelLayout& layout) {
    for (std::size_t i = 0; i < set.bands.size();) {
        std::size_t end = i + 1;
        while (end < set.bands.size() && set.bands[end].wavelength_nm == set.bands[i].wavelength_nm)
            ++end;
        if (end - i > 1) {
            std::vector<std::string> names;
            for (std::size_t k = i; k < end; ++k)
                names.push_back(layout.channel_names[set.bands[k].channel]);
            layout.warnings.push_back(quoted_list(names) + " are the same wavelength, " +
                                      format_double(set.bands[i].wavelength_nm) +
                                      " nm; a collapse takes their mean");
        }
        i = end;
    }
}

/// Pairs of the same two wavelengths, and pairs against Stokes' law: fluorescence makes waves longer.
void warn_of_reradiation(const SpectralSet& set, ChannelLayout& layout) {
    std::vector<std::string> same, uphill;
    for (std::size_t i = 0; i < set.reradiation.size(); ++i) {
        const Reradiation& pair = set.reradiation[i];
        const std::string& name = layout.channel_names[pair.channel];
        if (i > 0 && set.reradiation[i - 1].excited_nm == pair.excited_nm &&
            set.reradiation[i - 1].emitted_nm == pair.emitted_nm)
            same.push_back(name);
        if (pair.emitted_nm <= pair.excited_nm)
            uphill.push_back(name);
    }
    if (!same.empty())
        layout.warnings.push_back(
            quoted_list(same) + (same.size() == 1 ? " is a pair" : " are pairs") +
            " of wavelengths that another channel has too; a collapse takes their mean");
    if (!uphill.empty())
        layout.warnings.push_back(quoted_list(uphill) + (uphill.size() == 1 ? " leaves" : " leave") +
                                  " at no longer wavelength than the light that excites, as no fluorescence "
                                  "does; a collapse takes the names at their word");
}

void warn_of_near_misses(ChannelLayout& layout) {
    std::vector<std::string> names;
    for (const std::size_t channel : layout.others)
        if (looks_like_a_band(layout.channel_names[channel]))
            names.push_back(layout.channel_names[channel]);
    if (!names.empty())
        layout.warnings.push_back(quoted_list(names) + (names.size() == 1 ? " is" : " are") +
                                  " no band: a band name reads FAMILY.NUMBER[PREFIX]UNIT with a "
                                  "comma as decimal mark, such as T.450nm or S0.550,5nm");
}

}  // namespace

std::string_view quantity_name(Quantity quantity) {
    return quantity == Quantity::Reflectance ? "reflectance" : "radiance";
}

bool names_a_band(const Dialect& dialect, std::string_view attribute_name) {
    const auto& names = dialect.attributes;
    return std::find(names.begin(), names.end(), attribute_name) != names.end();
}

std::string without_wavelengths(const Dialect& dialect) {
    return "found " + dialect.name + " (" + dialect.evidence +
           "), which say no wavelengths; give them with wavelengths=400:10:700, or with wavelengths=FILE.csv "
           "of "
           "lines channel,nm";
}

std::string SpectralSet::name() const {
    return (root.empty() ? std::string() : root + ".") + std::string(family_name(family));
}

Quantity quantity_of(Family family) {
    return family == Family::T ? Quantity::Reflectance : Quantity::Radiance;
}

Quantity SpectralSet::quantity() const {
    return quantity_of(family);
}

std::vector<double> SpectralSet::wavelengths_nm() const {
    std::vector<double> out;
    out.reserve(bands.size());
    for (const Band& band : bands)
        out.push_back(band.wavelength_nm);
    return out;
}

std::optional<std::size_t> ChannelLayout::find_channel(std::string_view name) const {
    const auto found = std::find(channel_names.begin(), channel_names.end(), name);
    if (found == channel_names.end())
        return std::nullopt;
    return static_cast<std::size_t>(found - channel_names.begin());
}

const SpectralSet* ChannelLayout::find_set(std::string_view name) const {
    const auto found =
        std::find_if(sets.begin(), sets.end(), [name](const SpectralSet& set) { return set.name() == name; });
    return found == sets.end() ? nullptr : &*found;
}

std::optional<std::size_t> ChannelLayout::alpha_of(const SpectralSet& set) const {
    const auto other = [this](std::string_view name) {
        const auto channel = find_channel(name);
        const bool band = channel && !std::binary_search(others.begin(), others.end(), *channel);
        return band ? std::nullopt : channel;
    };
    if (!set.root.empty())
        if (const auto own = other(set.root + ".A"))
            return own;
    return other("A");
}

ChannelLayout make_channel_layout(std::span<const std::string> channel_names,
                                  std::span<const std::optional<ChannelName>> meanings) {
    ChannelLayout layout;
    layout.channel_names.assign(channel_names.begin(), channel_names.end());

    std::map<std::pair<std::string, Family>, SpectralSet> sets;
    for (std::size_t channel = 0; channel < channel_names.size(); ++channel) {
        const auto& name = meanings[channel];
        if (!name) {
            layout.others.push_back(channel);
            continue;
        }
        SpectralSet& set = sets[{name->root, name->family}];
        if (name->emitted_nm)
            set.reradiation.push_back({name->wavelength_nm, *name->emitted_nm, channel});
        else
            set.bands.push_back({name->wavelength_nm, channel});
    }
    for (auto& [key, set] : sets) {
        set.root = key.first;
        set.family = key.second;
        std::stable_sort(set.bands.begin(), set.bands.end(),
                         [](const Band& a, const Band& b) { return a.wavelength_nm < b.wavelength_nm; });
        std::stable_sort(
            set.reradiation.begin(), set.reradiation.end(), [](const Reradiation& a, const Reradiation& b) {
                return std::pair(a.excited_nm, a.emitted_nm) < std::pair(b.excited_nm, b.emitted_nm);
            });
        warn_of_duplicates(set, layout);
        warn_of_reradiation(set, layout);
        layout.sets.push_back(std::move(set));
    }
    return layout;
}

ChannelLayout parse_channel_layout(std::span<const std::string> channel_names, DecimalMark mark) {
    std::vector<std::optional<ChannelName>> meanings;
    meanings.reserve(channel_names.size());
    for (const std::string& name : channel_names)
        meanings.push_back(parse_channel_name(name, mark));
    ChannelLayout layout = make_channel_layout(channel_names, meanings);
    warn_of_near_misses(layout);
    if (!layout.sets.empty())
        layout.dialect = {std::string(kLayoutDialect), "names such as \"" + first_band(layout) + "\"", {}};
    return layout;
}

}  // namespace osio
