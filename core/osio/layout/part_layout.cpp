// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/dialect.h>
#include <osio/layout/part_layout.h>

#include <algorithm>

namespace osio {

namespace {

using Meanings = std::vector<std::optional<ChannelName>>;

/// "wavelength:width;..." of what a map gives widths.
std::string fwhm_text(std::span<const std::optional<MappedBand>> places) {
    std::string out;
    for (const auto& place : places)
        if (place && place->fwhm_nm)
            out += format_wavelength(place->wavelength_nm, DecimalMark::Point) + ":" +
                   format_double(*place->fwhm_nm) + ";";
    return out;
}

Meanings meanings_of(const ChannelLayout& layout) {
    Meanings out(layout.channel_names.size());
    for (const SpectralSet& set : layout.sets)
        for (const Band& band : set.bands)
            out[band.channel] = ChannelName{set.root, set.family, band.wavelength_nm, std::nullopt};
    return out;
}

/// Contradiction where the word fits no set.
Result<void> check_sets(const ChannelLayout& layout, std::optional<Quantity> word) {
    const auto& sets = layout.sets;
    if (sets.empty() ||
        std::any_of(sets.begin(), sets.end(), [&](const SpectralSet& set) { return set.quantity() == word; }))
        return {};
    return check_quantity(word, sets.front().quantity(),
                          "the bands are " + sets.front().name() + " of the " + layout.dialect.name);
}

/// The map's wavelengths for the channels of a part that was read by its names.
Result<PartLayout> mapped(const PartLayout& by_name, const OpenWords& words) {
    const auto& names = by_name.layout.channel_names;
    OSIO_TRY(const auto places, map_bands(*words.wavelengths, names));
    Meanings meanings = meanings_of(by_name.layout);
    std::vector<std::string> warnings;
    std::optional<Family> assumed;
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        if (!places[channel]) {
            meanings[channel].reset();
            continue;
        }
        if (!meanings[channel]) {
            if (!assumed)
                assumed = assumed_family(words.quantity, warnings);
            meanings[channel] = ChannelName{{}, *assumed, 0, std::nullopt};
        }
        meanings[channel]->wavelength_nm = places[channel]->wavelength_nm;
    }
    PartLayout out{make_channel_layout(names, meanings), by_name.attributes, {}};
    out.layout.dialect = by_name.layout.dialect;
    out.layout.dialect.name = "user's map";
    out.layout.dialect.evidence = "wavelengths=" + words.wavelengths->words;
    out.layout.warnings.insert(out.layout.warnings.begin(), warnings.begin(), warnings.end());
    for (const std::string_view name : {attribute::kBinEdges, attribute::kFwhm}) {
        out.attributes.erase(std::string(name));
        out.replaced.emplace_back(name);
    }
    for (std::size_t channel = 0; channel < names.size(); ++channel)
        if (places[channel])
            out.replaced.push_back(names[channel]);  // a sensitivity, which has wavelengths of its own
    if (const std::string fwhm = fwhm_text(places); !fwhm.empty())
        out.attributes.emplace(attribute::kFwhm, fwhm);
    return out;
}

}  // namespace

Family assumed_family(std::optional<Quantity> quantity, std::vector<std::string>& warnings) {
    if (!quantity)
        warnings.emplace_back(
            "nothing says whether the bands are reflectance or radiance: taken as reflectance; "
            "quantity=radiance makes them radiance, quantity=reflectance ends this warning");
    return quantity == Quantity::Radiance ? Family::S0 : Family::T;
}

Result<void> check_quantity(std::optional<Quantity> word, Quantity stated, std::string_view says) {
    if (!word || *word == stated)
        return {};
    return fail(ErrorCode::Contradiction, "quantity=" + std::string(quantity_name(*word)) +
                                              " does not fit: " + std::string(says) + ", which is " +
                                              std::string(quantity_name(stated)));
}

Result<PartLayout> read_part_layout(std::span<const std::string> channel_names,
                                    const HeaderAttributes& header, const OpenWords& words) {
    PartLayout out{parse_channel_layout(channel_names, DecimalMark::Comma), {}, {}};
    std::vector<std::string> attributes;
    for (const auto* named : {&header.texts, &header.numbers})
        for (const auto& [name, value] : *named)
            attributes.push_back(name);
    if (out.layout.sets.empty())
        if (const auto dialect = recognise_dialect(channel_names, attributes))
            out.layout.dialect = {*dialect, "a dialect that is not read yet", {}};
    OSIO_CHECK_OK(check_sets(out.layout, words.quantity));
    return words.wavelengths ? mapped(out, words) : out;
}

}  // namespace osio
