// SPDX-License-Identifier: Apache-2.0
#include <formats/files/text_file.h>
#include <formats/image/colour_attributes.h>
#include <formats/image/header_attributes.h>
#include <formats/image/preview_plan.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace osio::image {

Result<CollapsePlan> preview_plan(const SpectralSet& set, const SpectralMetadata& metadata,
                                  const std::string& light) {
    CollapseRequest request;
    OSIO_CHECK_OK(set_option(request, "to", "lin_rec709"));
    request.set = set.name();
    if (!iequals(light, "none"))
        request.illuminant = light;
    return make_plan(set, metadata, request, files::text_loader({}));
}

void insert_preview_attributes(const CollapsePlan& plan, Imf::Header& header) {
    erase_attributes({std::string(osio::attribute::kExposureValue), attribute::kColorSpace}, header);
    header.insert(attribute::kChromaticities, Imf::ChromaticitiesAttribute(chromaticities_of(plan.space)));
    header.insert(attribute::kPreviewRecipe, Imf::StringAttribute(recipe_text(plan.request)));
}

}  // namespace osio::image
