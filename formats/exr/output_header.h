// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <OpenEXR/ImfHeader.h>

#include <string_view>

namespace osio::exr {

/// Attributes that say how colour came from spectra.
namespace attribute {
inline constexpr const char* kRecipe = "spectral:recipe";      ///< the request, as a query spells it
inline constexpr const char* kPlan = "spectral:plan";          ///< CollapsePlan::id
inline constexpr const char* kConfig = "spectral:ocio";        ///< the OCIO config and processor, in words
inline constexpr const char* kWarnings = "spectral:warnings";  ///< what was doubtful, in words
inline constexpr const char* kMissingRows = "spectral:missingRows";  ///< "16-31,48-63": black, were damaged
inline constexpr const char* kColorSpace = "oiio:ColorSpace";        ///< a name that OCIO configs know
inline constexpr const char* kChromaticities = "chromaticities";
}  // namespace attribute

/// The header of a collapse: windows, pixel aspect, timecode and every other attribute of the part,
/// without those that describe its bands, tiles or parts; with the space's chromaticities, its
/// `oiio:ColorSpace` where one is true, and how it was made. No channels; compression zip.
[[nodiscard]] Imf::Header collapsed_header(const image::CollapseJob& job);

/// True for attributes that belong to the file's structure and are never copied as metadata.
[[nodiscard]] bool is_structural(std::string_view attribute_name);

}  // namespace osio::exr
