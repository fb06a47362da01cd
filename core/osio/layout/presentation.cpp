// SPDX-License-Identifier: Apache-2.0
#include <osio/layout/presentation.h>

#include <algorithm>
#include <array>
#include <set>

namespace osio {

namespace {

constexpr std::array<std::string_view, 4> kFirst{"R", "G", "B", "A"};

bool comes_first(std::string_view name) {
    return std::find(kFirst.begin(), kFirst.end(), name) != kFirst.end();
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// "T.400nm" becomes "T.400,0nm", "T.400.5nm" becomes "T.400.50nm": the same wavelength under another
/// name. `name` is one of ours, so it ends in digits and "nm".
std::string with_another_zero(std::string name, DecimalMark mark) {
    const std::size_t unit = name.size() - 2;
    std::size_t first = unit;
    while (first > 0 && is_digit(name[first - 1]))
        --first;
    // A point between two digits is a decimal mark, a point behind a letter ends a field.
    const bool fraction =
        first >= 2 && (name[first - 1] == ',' || (name[first - 1] == '.' && is_digit(name[first - 2])));
    const char* const more = fraction ? "0" : mark == DecimalMark::Comma ? ",0" : ".0";
    return name.insert(unit, more);
}

/// The name of a band in nanometres that nothing else has yet; it is taken from then on.
std::string take_name(const ChannelName& band, DecimalMark mark, std::set<std::string>& taken) {
    std::string name = format_channel_name(band, mark);
    while (!taken.insert(name).second)
        name = with_another_zero(std::move(name), mark);
    return name;
}

/// Calls visit(channel, name) for every band and pair, set by set in order of wavelength.
template <class Visit>
void for_each_band(const ChannelLayout& layout, Visit visit) {
    for (const SpectralSet& set : layout.sets) {
        for (const Band& band : set.bands)
            visit(band.channel, ChannelName{set.root, set.family, band.wavelength_nm, std::nullopt});
        for (const Reradiation& pair : set.reradiation)
            visit(pair.channel, ChannelName{set.root, set.family, pair.excited_nm, pair.emitted_nm});
    }
}

}  // namespace

std::vector<PresentedChannel> present_channels(const ChannelLayout& layout, BandNames names) {
    std::vector<PresentedChannel> out;
    std::set<std::string> taken;
    for (const std::size_t channel : layout.others)
        taken.insert(layout.channel_names[channel]);
    const auto add_band = [&](std::size_t channel, const ChannelName& band) {
        out.push_back({channel, names == BandNames::AsStored ? layout.channel_names[channel]
                                                             : take_name(band, DecimalMark::Point, taken)});
    };

    const auto is_other = [&layout](std::size_t channel) {
        return std::binary_search(layout.others.begin(), layout.others.end(), channel);
    };
    for (const std::string_view first : kFirst)
        if (const auto channel = layout.find_channel(first); channel && is_other(*channel))
            out.push_back({*channel, std::string(first)});
    for_each_band(layout, add_band);
    for (const std::size_t channel : layout.others)
        if (!comes_first(layout.channel_names[channel]))
            out.push_back({channel, layout.channel_names[channel]});
    return out;
}

std::vector<std::string> written_names(const ChannelLayout& layout) {
    std::vector<std::string> out(layout.channel_names);
    std::set<std::string> taken;
    for (const std::size_t channel : layout.others)
        taken.insert(layout.channel_names[channel]);
    for_each_band(layout, [&](std::size_t channel, const ChannelName& band) {
        out[channel] = take_name(band, DecimalMark::Comma, taken);
    });
    return out;
}

std::vector<std::string> layout_names(std::span<const std::string> names) {
    std::vector<std::string> out;
    std::set<std::string> taken;
    for (const std::string& given : names) {
        auto name = parse_channel_name(given, DecimalMark::Comma);
        if (!name)
            name = parse_channel_name(given, DecimalMark::Point);
        out.push_back(name ? take_name(*name, DecimalMark::Comma, taken) : given);
    }
    return out;
}

}  // namespace osio
