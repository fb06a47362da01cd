// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>
#include <osio/colour/colour_transform.h>

#include <memory>
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

/// CIE D50 as RGB standards round it (ISO 22028-2).
inline constexpr Chromaticity kD50{0.3457, 0.3585};

/// The white of ACES (SMPTE ST 2065-1).
inline constexpr Chromaticity kAcesWhite{0.32168, 0.33767};

/// What a pixel's three numbers mean.
enum class SpaceKind {
    Xyz,        ///< tristimulus values under the light itself, not adapted
    XyzD65,     ///< tristimulus values adapted to D65
    Rgb,        ///< red, green, blue of given primaries
    Lab,        ///< CIE 1976 L* a* b* (cie_lab.h); as the next three, of values under the light itself
    Luv,        ///< CIE 1976 L* u* v*
    XyY,        ///< chromaticity x, y, and Y
    Uv,         ///< CIE 1976 chromaticity u', v', and Y
    Luminance,  ///< Y alone, not adapted
    Camera,     ///< a camera's own red, green, blue
    Display,    ///< red, green, blue that a measured display needs to show the colour
    S0,         ///< Y of the Stokes component S0; as the next three, not adapted, with its sign
    S1,
    S2,
    S3,
    DoP,   ///< degree of polarisation of those four (polarisation.h)
    DoLP,  ///< degree of linear polarisation
    DoCP,  ///< degree of circular polarisation
    AoLP,  ///< angle of linear polarisation, degrees
};

/// True where a value is a degree or an angle, made of Stokes components.
[[nodiscard]] constexpr bool is_polarisation(SpaceKind kind) {
    return kind == SpaceKind::DoP || kind == SpaceKind::DoLP || kind == SpaceKind::DoCP ||
           kind == SpaceKind::AoLP;
}

/// True where a value is a Stokes component or made of them.
[[nodiscard]] constexpr bool is_polarimetric(SpaceKind kind) {
    return is_polarisation(kind) || kind == SpaceKind::S0 || kind == SpaceKind::S1 || kind == SpaceKind::S2 ||
           kind == SpaceKind::S3;
}

/// True for one value a pixel.
[[nodiscard]] constexpr bool is_single(SpaceKind kind) {
    return kind == SpaceKind::Luminance || is_polarimetric(kind);
}

/// True where the values are sums over bands, and a curve at most.
[[nodiscard]] constexpr bool is_tristimulus(SpaceKind kind) {
    return kind != SpaceKind::Lab && kind != SpaceKind::Luv && kind != SpaceKind::XyY &&
           kind != SpaceKind::Uv && !is_polarisation(kind);
}

/// True where values are adapted to the white of the space.
[[nodiscard]] constexpr bool is_adapted(SpaceKind kind) {
    return kind == SpaceKind::XyzD65 || kind == SpaceKind::Rgb || kind == SpaceKind::Display;
}

/// True where values depend on a white: adapted from it, or relative to it.
[[nodiscard]] constexpr bool has_white(SpaceKind kind) {
    return is_adapted(kind) || (!is_tristimulus(kind) && !is_polarisation(kind));
}

/// True for the spaces whose numbers are red, green and blue.
[[nodiscard]] constexpr bool is_rgb(SpaceKind kind) {
    return kind == SpaceKind::Rgb || kind == SpaceKind::Camera || kind == SpaceKind::Display;
}

/// True where the space's primaries and white say what its numbers are. Those of Display come from the
/// display's table.
[[nodiscard]] constexpr bool has_primaries(SpaceKind kind) {
    return kind == SpaceKind::Xyz || is_adapted(kind);
}

/// Curve from linear to stored value.
enum class Transfer {
    Linear,
    Srgb,  ///< IEC 61966-2-1
};

/// The values of a kind: "X" "Y" "Z", "R" "G" "B", "L*" "a*" "b*", "L*" "u*" "v*", "x" "y" "Y",
/// "u'" "v'" "Y"; "Y", "S0" to "S3", "DoP", "DoLP", "DoCP" or "AoLP" alone. (Stars also keep a* apart from alpha where names are compared without case.)
[[nodiscard]] std::vector<std::string> space_outputs(SpaceKind kind);

/// A space that spectra can be collapsed to.
struct OutputSpace {
    std::string id;           ///< "lin_rec709"; what find_output_space reads; "ocio:NAME" of a config's
    std::string aliases;      ///< further names, separated by '|'
    std::string color_space;  ///< the name for `oiio:ColorSpace`; empty where none is true
    SpaceKind kind{};
    Transfer transfer{};
    Chromaticity red, green, blue, white;  ///< of the stored primaries
    /// Where the space belongs to a colour config: the way to it from the space that the rest
    /// describes, in which the weights end.
    std::shared_ptr<const ColourTransform> transform{};
};

/// All spaces, in the order in which `list spaces` shows them.
[[nodiscard]] std::span<const OutputSpace> output_spaces();

/// The space of that id or alias (case ignored); or a linear RGB space from chromaticities of its
/// primaries and white, `rgb:xr,yr,xg,yg,xb,yb,xw,yw`. UnknownName names the nearest; Usage says why
/// chromaticities make no space.
[[nodiscard]] Result<OutputSpace> find_output_space(std::string_view name);

/// Every id of output_spaces(), without the aliases.
[[nodiscard]] std::vector<std::string> output_space_names();

/// The normalised primary matrix (SMPTE RP 177-1993, 3): XYZ of RGB, with (1,1,1) the white at Y = 1.
[[nodiscard]] Matrix3 xyz_from_rgb(const OutputSpace& space);

/// The sRGB curve of IEC 61966-2-1, with its straight part continued below zero and its power
/// continued above one, as OCIO's ExponentWithLinear does: nothing is clipped.
[[nodiscard]] double srgb_encode(double linear);

/// Its inverse.
[[nodiscard]] double srgb_decode(double encoded);

}  // namespace osio
