// SPDX-License-Identifier: Apache-2.0
#include <formats/image/attribute_text.h>
#include <formats/image/band_facts.h>

#include <osio/base/text.h>
#include <osio/layout/presentation.h>
#include <osio/layout/spectral_metadata.h>

#include <algorithm>

namespace osio::image {

std::vector<std::string> channel_names(std::span<const BandFacts> bands, Family family) {
    std::vector<std::string> names;
    for (const BandFacts& band : bands)
        names.push_back(band.usable()
                            ? format_channel_name({{}, family, band.wavelength_nm, {}}, DecimalMark::Comma)
                            : (band.bad ? "bad." : "band.") + std::to_string(names.size() + 1));
    return layout_names(names);
}

std::string fwhm_text(std::span<const BandFacts> bands) {
    std::string out;
    for (const BandFacts& band : bands)
        if (band.wavelength_nm > 0 && band.fwhm_nm > 0)
            out += format_double(band.wavelength_nm) + "nm:" + format_double(band.fwhm_nm) + ";";
    return out;
}

void warn_of_unusable(std::span<const BandFacts> bands, std::string_view bad_by,
                      std::vector<std::string>& warnings) {
    const auto without = std::count_if(bands.begin(), bands.end(),
                                       [](const BandFacts& band) { return !(band.wavelength_nm > 0); });
    const auto bad =
        std::count_if(bands.begin(), bands.end(), [](const BandFacts& band) { return band.bad; });
    const std::string of = " of " + std::to_string(bands.size()) + " bands ";
    if (without > 0)
        warnings.push_back(std::to_string(without) + of +
                           "have no wavelength above 0 and are left out of the set");
    if (bad > 0)
        warnings.push_back(std::to_string(bad) + of + "are bad by \"" + std::string(bad_by) +
                           "\" and are left out of the set");
}

std::optional<Quantity> quantity_in(std::string_view words) {
    const std::string text = to_lower(words);
    const bool radiance = text.find("radiance") != std::string::npos;
    const bool reflectance = text.find("reflectance") != std::string::npos;
    if (radiance == reflectance)
        return std::nullopt;
    return radiance ? Quantity::Radiance : Quantity::Reflectance;
}

void insert_band_attributes(std::span<const BandFacts> bands, Family family, const std::string& units,
                            Imf::Header& header) {
    insert_text(std::string(attribute::kLayoutVersion), std::string(kWrittenLayoutVersion), header);
    if (family != Family::T)
        insert_text(std::string(attribute::kEmissiveUnits),
                    units.empty() ? std::string(kWrittenEmissiveUnits) : units, header);
    if (const std::string fwhm = fwhm_text(bands); !fwhm.empty())
        insert_text(std::string(attribute::kFwhm), fwhm, header);
}

void describe_bands(const std::vector<std::string>& names, const std::vector<std::string>& warnings,
                    Part& part) {
    for (const std::string& name : names)
        part.channels.push_back({name, SampleType::Float, false});
    part.layout = parse_channel_layout(names, DecimalMark::Comma);
    part.layout.dialect = {};  // the names are ours
    part.layout.warnings.insert(part.layout.warnings.begin(), warnings.begin(), warnings.end());
    part.metadata = read_spectral_metadata(part.layout, text_attributes(part.header));
}

}  // namespace osio::image
