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

/// The spelling in nanometres, else (where that is taken by a band of the same wavelength) the
/// file's own with a point, else the file's own.
std::string comma_free_name(const std::string& stored, const std::set<std::string>& taken) {
    const auto name = parse_channel_name(stored, DecimalMark::Comma);
    const std::string in_nm = format_channel_name(*name, DecimalMark::Point);
    if (!taken.contains(in_nm))
        return in_nm;
    std::string pointed = stored;
    std::replace(pointed.begin(), pointed.end(), ',', '.');
    return taken.contains(pointed) ? stored : pointed;
}

/// "T.400nm" becomes "T.400,0nm", "T.400,5nm" becomes "T.400,50nm": the same number.
std::string with_another_zero(std::string name) {
    const auto unit = name.size() - 2;  // canonical names end in "nm"
    const auto last_field = name.rfind('.');
    const bool has_comma = name.find(',', last_field) != std::string::npos;
    return name.insert(unit, has_comma ? "0" : ",0");
}

}  // namespace

std::vector<PresentedChannel> present_channels(const ChannelLayout& layout, BandNames names) {
    std::vector<PresentedChannel> out;
    std::set<std::string> taken;
    for (const std::size_t channel : layout.others)
        taken.insert(layout.channel_names[channel]);
    const auto add_band = [&](std::size_t channel) {
        const std::string& stored = layout.channel_names[channel];
        out.push_back({channel, names == BandNames::AsStored ? stored : comma_free_name(stored, taken)});
        taken.insert(out.back().name);
    };

    for (const std::string_view first : kFirst)
        if (const auto channel = layout.find_channel(first))
            out.push_back({*channel, std::string(first)});
    for (const SpectralSet& set : layout.sets) {
        for (const Band& band : set.bands)
            add_band(band.channel);
        for (const Reradiation& pair : set.reradiation)
            add_band(pair.channel);
    }
    for (const std::size_t channel : layout.others)
        if (!comes_first(layout.channel_names[channel]))
            out.push_back({channel, layout.channel_names[channel]});
    return out;
}

std::vector<std::string> layout_names(std::span<const std::string> names) {
    std::vector<std::string> out;
    std::set<std::string> taken;
    for (const std::string& given : names) {
        auto name = parse_channel_name(given, DecimalMark::Comma);
        if (!name)
            name = parse_channel_name(given, DecimalMark::Point);
        std::string written = name ? format_channel_name(*name, DecimalMark::Comma) : given;
        while (name && taken.contains(written))
            written = with_another_zero(std::move(written));
        taken.insert(written);
        out.push_back(std::move(written));
    }
    return out;
}

}  // namespace osio
