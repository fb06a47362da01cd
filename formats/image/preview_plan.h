// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>

#include <OpenEXR/ImfHeader.h>

#include <string>

namespace osio::image {

namespace attribute {
/// The recipe of R, G, B beside bands, as a query: what collapse makes of the bands with it.
inline constexpr const char* kPreviewRecipe = "spectral:previewRecipe";
}  // namespace attribute

/// How R, G, B are made of bands to lie beside them: the collapse to linear Rec. 709, with all its defaults, under
/// `light` (a name or the path of a table), or "none" for radiance. Values are not clamped. The refusals of
/// make_plan().
[[nodiscard]] Result<CollapsePlan> preview_plan(const SpectralSet& set, const SpectralMetadata& metadata,
                                                const std::string& light);

/// Says in a header how its R, G, B were made: chromaticities and recipe. What another preview left goes
/// (`EV`, `oiio:ColorSpace`).
void insert_preview_attributes(const CollapsePlan& plan, Imf::Header& header);

}  // namespace osio::image
