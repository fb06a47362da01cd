// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/spectral_header.h>
#include <formats/image/header_attributes.h>

#include <osio/layout/channel_name.h>
#include <osio/layout/spectral_metadata.h>
#include <osio/spectra/spectrum.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace osio::exr {

namespace {

void insert_text(std::string_view name, std::string_view value, Imf::Header& header) {
    header.insert(std::string(name), Imf::StringAttribute(std::string(value)));
}

void insert_default(std::string_view name, std::string_view value, Imf::Header& header) {
    if (header.find(std::string(name)) == header.end())
        insert_text(name, value, header);
}

/// A curve's text in the spelling that others read; text that is no curve as it is.
std::string respelt(const std::string& text) {
    const SpectrumText parsed = parse_spectrum_text(text);
    return parsed.rejected.empty() && !parsed.spectrum.values.empty() ? format_spectrum_text(parsed.spectrum)
                                                                      : text;
}

void respell(std::string_view name, Imf::Header& header) {
    if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(std::string(name)))
        insert_text(name, respelt(text->value()), header);
}

void rename_sensitivities(const std::vector<std::string>& written, Imf::Header& header) {
    std::vector<std::pair<std::string, std::string>> curves;
    for (auto a = header.begin(); a != header.end(); ++a)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
            if (parse_channel_name(a.name(), DecimalMark::Comma))
                curves.emplace_back(a.name(), text->value());
    std::set<std::string, std::less<>> old;
    for (const auto& [name, value] : curves)
        old.insert(name);
    image::erase_attributes(old, header);
    for (const auto& [name, value] : curves) {
        const auto band = parse_channel_name(name, DecimalMark::Comma);
        for (const std::string& channel : written)
            if (parse_channel_name(channel, DecimalMark::Comma) == band)
                insert_text(channel, respelt(value), header);
    }
}

}  // namespace

void complete_spectral_header(const ChannelLayout& layout, Imf::Header& header) {
    const auto any = [&layout](auto fits) {
        return std::any_of(layout.sets.begin(), layout.sets.end(), fits);
    };
    rename_sensitivities(layout.channel_names, header);
    respell(attribute::kLensTransmission, header);
    respell(attribute::kCameraResponse, header);
    insert_text(attribute::kLayoutVersion, kWrittenLayoutVersion, header);
    if (any([](const SpectralSet& s) { return s.quantity() == Quantity::Radiance; }))
        insert_default(attribute::kEmissiveUnits, kWrittenEmissiveUnits, header);
    if (any([](const SpectralSet& s) { return s.family != Family::S0 && s.family != Family::T; }))
        insert_default(attribute::kHandedness, "right", header);
}

}  // namespace osio::exr
