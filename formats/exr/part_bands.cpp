// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/part_bands.h>
#include <formats/image/header_attributes.h>

#include <osio/layout/part_layout.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <optional>
#include <string>
#include <utility>

namespace osio::exr {

namespace {

Result<PartLayout> layout_of(const image::Part& part, const OpenWords& words) {
    std::vector<std::string> names;
    for (const image::Channel& channel : part.channels)
        names.push_back(channel.name);
    return read_part_layout(names, image::header_attributes(part.header), words);
}

void take(PartLayout layout, image::Part& part) {
    image::erase_attributes({layout.replaced.begin(), layout.replaced.end()}, part.header);
    for (const auto& [name, value] : layout.attributes)
        part.header.insert(name, Imf::StringAttribute(value));
    part.layout = std::move(layout.layout);
    for (const SpectralSet& set : part.layout.sets)
        for (const Band& band : set.bands)
            part.channels[band.channel].scale = layout.scale;
    part.metadata = read_spectral_metadata(part.layout, image::text_attributes(part.header));
}

}  // namespace

Result<void> understand_bands(std::vector<image::Part>& parts, const OpenWords& words) {
    std::vector<Result<PartLayout>> layouts;
    std::optional<Error> first;
    bool fits = false;
    for (const image::Part& part : parts) {
        layouts.push_back(layout_of(part, words));
        fits = fits || layouts.back();
        if (!layouts.back() && !first)
            first = layouts.back().error();
    }
    if (!fits && first)
        return tl::unexpected(*first);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (layouts[i]) {
            take(std::move(*layouts[i]), parts[i]);
            continue;
        }
        OSIO_TRY(PartLayout by_name, layout_of(parts[i], {}));
        by_name.layout.warnings.push_back(layouts[i].error().text() + ": this part is read without the word");
        take(std::move(by_name), parts[i]);
    }
    return {};
}

}  // namespace osio::exr
