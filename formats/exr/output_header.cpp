// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/output_header.h>
#include <formats/image/colour_attributes.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>

namespace osio::exr {

namespace {

/// "osio $1f2e, from ACES2065-1 by processor $3d4c".
std::string config_text(const TransformSource& source) {
    const std::string name = source.config_name.empty() ? source.config_file : source.config_name;
    return name + " " + source.config_id + ", from " + source.from + " by processor " + source.processor;
}

/// Attributes that describe what a collapse replaces.
bool is_replaced(std::string_view name) {
    constexpr std::array<std::string_view, 2> kOwn{image::attribute::kChromaticities,
                                                   image::attribute::kColorSpace};
    return std::find(kOwn.begin(), kOwn.end(), name) != kOwn.end() || name.starts_with("spectral:");
}

}  // namespace

bool is_structural(std::string_view name) {
    constexpr std::array<std::string_view, 13> kStructure{"channels",
                                                          "compression",
                                                          "dataWindow",
                                                          "displayWindow",
                                                          "lineOrder",
                                                          "tiles",
                                                          "type",
                                                          "version",
                                                          "chunkCount",
                                                          "maxSamplesPerPixel",
                                                          "multiView",
                                                          "dwaCompressionLevel",
                                                          attribute::kChecksum};
    return std::find(kStructure.begin(), kStructure.end(), name) != kStructure.end();
}

Imf::Header collapsed_header(const image::CollapseJob& job) {
    const image::Part& part = job.part();
    const CollapsePlan& plan = job.plan;
    Imf::Header out(part.header.displayWindow(), part.header.dataWindow());
    for (auto a = part.header.begin(); a != part.header.end(); ++a)
        if (!is_structural(a.name()) && !describes_bands(a.name()) && !is_replaced(a.name()) &&
            !names_a_band(part.layout.dialect, a.name()))
            out.insert(a.name(), a.attribute());
    const OutputSpace& space = plan.space;
    if (part.metadata.handedness && (is_polarimetric(space.kind) || plan.has_sign))
        out.insert(std::string(osio::attribute::kHandedness),
                   Imf::StringAttribute(*part.metadata.handedness));
    if (has_primaries(space.kind) && !space.transform)
        out.insert(image::attribute::kChromaticities,
                   Imf::ChromaticitiesAttribute(image::chromaticities_of(space)));
    if (!space.color_space.empty())
        out.insert(image::attribute::kColorSpace, Imf::StringAttribute(space.color_space));
    out.insert(image::attribute::kRecipe, Imf::StringAttribute(recipe_text(plan.request)));
    out.insert(image::attribute::kPlan, Imf::StringAttribute(plan.id));
    if (space.transform)
        out.insert(image::attribute::kConfig, Imf::StringAttribute(config_text(space.transform->source())));
    if (!job.warnings.empty())
        out.insert(image::attribute::kWarnings, Imf::StringAttribute(join(job.warnings, "\n")));
    out.compression() = Imf::ZIP_COMPRESSION;
    return out;
}

}  // namespace osio::exr
