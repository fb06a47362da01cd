// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/colour/rgb_space.h>

#include <OpenEXR/ImfChromaticities.h>

namespace osio::image {

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

/// The primaries and white of a space that has them.
[[nodiscard]] inline Imf::Chromaticities chromaticities_of(const OutputSpace& space) {
    const auto v2f = [](const Chromaticity& c) {
        return Imath::V2f(static_cast<float>(c.x), static_cast<float>(c.y));
    };
    return {v2f(space.red), v2f(space.green), v2f(space.blue), v2f(space.white)};
}

}  // namespace osio::image
