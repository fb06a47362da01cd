// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// CIE 1931 chromaticity.
struct Chromaticity {
    double x = 0;
    double y = 0;

    /// Tristimulus values with Y = 1.
    [[nodiscard]] constexpr Vector3 xyz() const { return {x / y, 1.0, (1 - x - y) / y}; }

    friend constexpr bool operator==(const Chromaticity&, const Chromaticity&) = default;
};

/// CIE D65 as RGB standards round it (ITU-R BT.709-6, IEC 61966-2-1).
inline constexpr Chromaticity kD65{0.3127, 0.3290};

/// The white of ACES (SMPTE ST 2065-1).
inline constexpr Chromaticity kAcesWhite{0.32168, 0.33767};

/// What a pixel's three numbers mean.
enum class SpaceKind {
    Xyz,        ///< tristimulus values under the light itself, not adapted
    XyzD65,     ///< tristimulus values adapted to D65
    Rgb,        ///< red, green, blue of given primaries
    Luminance,  ///< Y alone
    Camera,     ///< a camera's own red, green, blue
    Display,    ///< red, green, blue that a measured display needs to show the colour
};

/// True for the spaces whose numbers are red, green and blue.
[[nodiscard]] constexpr bool is_rgb(SpaceKind kind) {
    return kind == SpaceKind::Rgb || kind == SpaceKind::Camera || kind == SpaceKind::Display;
}

/// True for the spaces that are not adapted to a white of their own.
[[nodiscard]] constexpr bool is_unadapted(SpaceKind kind) {
    return kind == SpaceKind::Xyz || kind == SpaceKind::Luminance || kind == SpaceKind::Camera;
}

/// True where the space's primaries and white say what its numbers are. Those of Display come from the
/// display's table.
[[nodiscard]] constexpr bool has_primaries(SpaceKind kind) {
    return kind != SpaceKind::Luminance && kind != SpaceKind::Camera;
}

/// Curve from linear to stored value.
enum class Transfer {
    Linear,
    Srgb,  ///< IEC 61966-2-1
};

/// A space that spectra can be collapsed to.
struct OutputSpace {
    std::string_view id;           ///< "lin_rec709"
    std::string_view aliases;      ///< further names, separated by '|'
    std::string_view color_space;  ///< the name for `oiio:ColorSpace`; empty where none is true
    SpaceKind kind{};
    Transfer transfer{};
    Chromaticity red, green, blue, white;  ///< of the stored primaries
};

/// All spaces, in the order in which `list spaces` shows them.
[[nodiscard]] std::span<const OutputSpace> output_spaces();

/// The space of that id or alias (case ignored). UnknownName names the nearest.
[[nodiscard]] Result<OutputSpace> find_output_space(std::string_view name);

/// Every id, without the aliases.
[[nodiscard]] std::vector<std::string> output_space_names();

/// The normalised primary matrix (SMPTE RP 177-1993, 3): XYZ of RGB, with (1,1,1) the white at Y = 1.
[[nodiscard]] Matrix3 xyz_from_rgb(const OutputSpace& space);

/// Bradford chromatic adaptation (Lam 1985, as in ICC.1:2022 annex E) from one white to another.
[[nodiscard]] Matrix3 bradford_adaptation(const Vector3& from_white, const Vector3& to_white);

/// The sRGB curve of IEC 61966-2-1, with its straight part continued below zero and its power
/// continued above one, as OCIO's ExponentWithLinear does: nothing is clipped.
[[nodiscard]] double srgb_encode(double linear);

}  // namespace osio
