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
                          "the bands are " + sets.front().name() + " by the " + layout.dialect.name);
}

/// The family of bands whose quantity a dialect may say.
Family family_of(std::optional<Quantity> stated, const OpenWords& words, std::vector<std::string>& warnings) {
    if (stated)
        return *stated == Quantity::Radiance ? Family::S0 : Family::T;
    return assumed_family(words.quantity, warnings);
}

/// A part by its names and its header alone.
struct ByName {
    PartLayout part;
    Meanings meanings;
    std::optional<Quantity> stated;     ///< by the dialect, of channels that are no bands by name
    std::vector<std::string> warnings;  ///< that hold under a map too
};

ByName by_name(std::span<const std::string> names, const HeaderAttributes& header, const OpenWords& words) {
    ByName out{{parse_channel_layout(names, DecimalMark::Comma), {}, {}, 1}, {}, {}, {}};
    out.meanings = meanings_of(out.part.layout);
    if (!out.part.layout.sets.empty())
        return out;
    auto reading = read_dialect(names, header);
    if (!reading)
        return out;
    out.stated = reading->quantity;
    out.meanings = std::move(reading->bands);
    out.warnings = reading->warnings;
    std::vector<std::string> warnings = std::move(out.part.layout.warnings);
    warnings.insert(warnings.end(), reading->warnings.begin(), reading->warnings.end());
    const bool bands = std::any_of(out.meanings.begin(), out.meanings.end(), [](const auto& m) { return m; });
    if (bands && !reading->quantity) {
        const Family family = family_of(reading->quantity, words, warnings);
        for (auto& meaning : out.meanings)
            if (meaning)
                meaning->family = family;
    }
    if (!bands)
        warnings.push_back(without_wavelengths(reading->dialect));
    out.part.layout = make_channel_layout(names, out.meanings);
    out.part.layout.dialect = std::move(reading->dialect);
    out.part.layout.warnings.insert(out.part.layout.warnings.begin(), warnings.begin(), warnings.end());
    out.part.attributes = std::move(reading->attributes);
    out.part.scale = reading->scale;
    return out;
}

/// The map's wavelengths for the channels of a part that was read by its names.
Result<PartLayout> mapped(ByName named, const OpenWords& words) {
    const auto& names = named.part.layout.channel_names;
    OSIO_TRY(const auto places, map_bands(*words.wavelengths, names));
    std::vector<std::string> warnings = std::move(named.warnings);
    std::optional<Family> assumed;
    std::vector<std::string> replaced{std::string(attribute::kBinEdges), std::string(attribute::kFwhm)};
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        auto& meaning = named.meanings[channel];
        if (!places[channel]) {
            meaning.reset();
            continue;
        }
        if (!meaning) {
            if (!assumed)
                assumed = family_of(named.stated, words, warnings);
            meaning = ChannelName{{}, *assumed, 0, std::nullopt};
        }
        meaning->wavelength_nm = places[channel]->wavelength_nm;
        replaced.push_back(names[channel]);  // a sensitivity, which has wavelengths of its own
    }
    PartLayout out{make_channel_layout(names, named.meanings), named.part.attributes, std::move(replaced),
                   named.part.scale};
    out.layout.dialect = {"user's map", "wavelengths=" + words.wavelengths->words,
                          std::move(named.part.layout.dialect.attributes)};
    out.layout.warnings.insert(out.layout.warnings.begin(), warnings.begin(), warnings.end());
    out.attributes.erase(std::string(attribute::kBinEdges));
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
    ByName named = by_name(channel_names, header, words);
    OSIO_CHECK_OK(check_sets(named.part.layout, words.quantity));
    if (!words.wavelengths)
        return std::move(named.part);
    return mapped(std::move(named), words);
}

}  // namespace osio
