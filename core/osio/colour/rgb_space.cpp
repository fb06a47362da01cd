// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/rgb_space.h>

#include <array>
#include <cmath>

namespace osio {

namespace {

constexpr Chromaticity kX{1, 0}, kY{0, 1}, kZ{0, 0}, kEqualEnergy{1.0 / 3.0, 1.0 / 3.0};

/// Primaries: ITU-R BT.709-6 and IEC 61966-2-1; SMPTE RP 431-2 with D65; ITU-R BT.2020-2;
/// ACES AP1 (S-2014-004) and AP0 (SMPTE ST 2065-1). Names and aliases are those of the official
/// OCIO configs for ACES, which have them since OCIO 2.1.
constexpr std::array<OutputSpace, 11> kSpaces{{
    {"xyz", "", "", SpaceKind::Xyz, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
    {"xyz_d65", "lin_ciexyzd65_scene|cie_xyz_d65_scene|CIE XYZ-D65 - Scene-referred", "lin_ciexyzd65_scene",
     SpaceKind::XyzD65, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
    {"luminance", "", "", SpaceKind::Luminance, Transfer::Linear, {}, {}, {}, {}},
    {"camera", "", "", SpaceKind::Camera, Transfer::Linear, {}, {}, {}, {}},
    {"display", "", "", SpaceKind::Display, Transfer::Linear, {}, {}, {}, {}},
    {"lin_rec709",
     "lin_rec709_scene|lin_rec709_srgb|lin_srgb|Linear Rec.709 (sRGB)",
     "lin_rec709",
     SpaceKind::Rgb,
     Transfer::Linear,
     {0.64, 0.33},
     {0.30, 0.60},
     {0.15, 0.06},
     kD65},
    {"lin_p3d65",
     "lin_p3d65_scene|lin_displayp3|Linear P3-D65",
     "lin_p3d65",
     SpaceKind::Rgb,
     Transfer::Linear,
     {0.680, 0.320},
     {0.265, 0.690},
     {0.150, 0.060},
     kD65},
    {"lin_rec2020",
     "lin_rec2020_scene|Linear Rec.2020",
     "lin_rec2020",
     SpaceKind::Rgb,
     Transfer::Linear,
     {0.708, 0.292},
     {0.170, 0.797},
     {0.131, 0.046},
     kD65},
    {"acescg",
     "lin_ap1|lin_ap1_scene|ACES - ACEScg",
     "ACEScg",
     SpaceKind::Rgb,
     Transfer::Linear,
     {0.713, 0.293},
     {0.165, 0.830},
     {0.128, 0.044},
     kAcesWhite},
    {"aces2065_1",
     "ACES2065-1|lin_ap0|lin_ap0_scene|ACES - ACES2065-1",
     "ACES2065-1",
     SpaceKind::Rgb,
     Transfer::Linear,
     {0.7347, 0.2653},
     {0, 1},
     {0.0001, -0.0770},
     kAcesWhite},
    {"srgb",
     "srgb_tx|srgb_texture|srgb_rec709_scene|sRGB - Texture",
     "sRGB",
     SpaceKind::Rgb,
     Transfer::Srgb,
     {0.64, 0.33},
     {0.30, 0.60},
     {0.15, 0.06},
     kD65},
}};

constexpr Matrix3 kBradford{
    {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}}};

}  // namespace

std::span<const OutputSpace> output_spaces() {
    return kSpaces;
}

std::vector<std::string> output_space_names() {
    std::vector<std::string> names;
    for (const OutputSpace& space : kSpaces)
        names.emplace_back(space.id);
    return names;
}

Result<OutputSpace> find_output_space(std::string_view name) {
    for (const OutputSpace& space : kSpaces) {
        if (iequals(space.id, name))
            return space;
        for (const std::string_view alias : split(space.aliases, '|'))
            if (!alias.empty() && iequals(alias, name))
                return space;
    }
    return fail(ErrorCode::UnknownName, "no output space is called \"" + std::string(name) + "\"" +
                                            suggestion(name, output_space_names()));
}

Matrix3 xyz_from_rgb(const OutputSpace& space) {
    // Columns are the primaries' (x, y, z), scaled so that their sum is the white's XYZ.
    const Chromaticity &r = space.red, &g = space.green, &b = space.blue;
    const Matrix3 primaries{
        {{{r.x, g.x, b.x}, {r.y, g.y, b.y}, {1 - r.x - r.y, 1 - g.x - g.y, 1 - b.x - b.y}}}};
    return primaries * Matrix3::diagonal(inverse(primaries) * space.white.xyz());
}

Matrix3 bradford_adaptation(const Vector3& from_white, const Vector3& to_white) {
    if (from_white == to_white)
        return Matrix3::identity();  // exactly, not to rounding
    const Vector3 from = kBradford * from_white;
    const Vector3 to = kBradford * to_white;
    return inverse(kBradford) *
           (Matrix3::diagonal({to[0] / from[0], to[1] / from[1], to[2] / from[2]}) * kBradford);
}

double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace osio
