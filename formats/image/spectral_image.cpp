// SPDX-License-Identifier: Apache-2.0
#include <formats/image/spectral_image.h>

#include <OpenEXR/ImfStringAttribute.h>

namespace osio::image {

PartSummary Part::summary() const {
    PartSummary out{name, &layout, deep, {}};
    for (const Channel& channel : channels)
        out.subsampled.push_back(channel.subsampled);
    return out;
}

std::vector<PartSummary> SpectralImage::summaries() const {
    std::vector<PartSummary> out;
    for (const Part& part : m_parts)
        out.push_back(part.summary());
    return out;
}

Result<Selection> SpectralImage::select(const CollapseRequest& request) const {
    const auto selection = select_set(summaries(), request);
    if (!selection)
        return fail_in(m_path, selection.error());
    return *selection;
}

TextAttributes text_attributes(const Imf::Header& header) {
    TextAttributes out;
    for (auto a = header.begin(); a != header.end(); ++a)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
            out.emplace(a.name(), text->value());
    return out;
}

}  // namespace osio::image
