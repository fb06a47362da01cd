// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/rgb_space.h>

#include <array>
#include <cmath>

namespace osio {

namespace {

constexpr Chromaticity kX{1, 0}, kY{0, 1}, kZ{0, 0}, kEqualEnergy{1.0 / 3.0, 1.0 / 3.0};

/// Primaries: ITU-R BT.709-6 and IEC 61966-2-1; SMPTE RP 431-2 with D65; ITU-R BT.2020-2;
/// ACES AP1 (S-2014-004) and AP0 (SMPTE ST 2065-1); Adobe RGB (1998) 4.3.1; ISO 22028-2 (ROMM RGB,
/// which Kodak called ProPhoto). Names and aliases of the first eight are those of the official OCIO
/// configs for ACES, which have them since OCIO 2.1.
const std::array<OutputSpace, 25>& spaces() {
    static const std::array<OutputSpace, 25> kSpaces{{
        {"xyz", "", "", SpaceKind::Xyz, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
        {"xyz_d65", "lin_ciexyzd65_scene|cie_xyz_d65_scene|CIE XYZ-D65 - Scene-referred",
         "lin_ciexyzd65_scene", SpaceKind::XyzD65, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
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
        {"lin_adobergb",
         "lin_adobergb_scene",
         "lin_adobergb_scene",
         SpaceKind::Rgb,
         Transfer::Linear,
         {0.64, 0.33},
         {0.21, 0.71},
         {0.15, 0.06},
         kD65},
        {"lin_prophoto",
         "lin_romm",
         "",
         SpaceKind::Rgb,
         Transfer::Linear,
         {0.7347, 0.2653},
         {0.1596, 0.8404},
         {0.0366, 0.0001},
         kD50},
        {"lab", "cielab", "", SpaceKind::Lab, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
        {"luv", "cieluv", "", SpaceKind::Luv, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
        {"xyY", "", "", SpaceKind::XyY, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
        {"uv", "uvY|u'v'Y", "", SpaceKind::Uv, Transfer::Linear, kX, kY, kZ, kEqualEnergy},
        {"luminance", "", "", SpaceKind::Luminance, Transfer::Linear, {}, {}, {}, {}},
        {"camera", "", "", SpaceKind::Camera, Transfer::Linear, {}, {}, {}, {}},
        {"display", "", "", SpaceKind::Display, Transfer::Linear, {}, {}, {}, {}},
        {"s0", "", "", SpaceKind::S0, Transfer::Linear, {}, {}, {}, {}},
        {"s1", "", "", SpaceKind::S1, Transfer::Linear, {}, {}, {}, {}},
        {"s2", "", "", SpaceKind::S2, Transfer::Linear, {}, {}, {}, {}},
        {"s3", "", "", SpaceKind::S3, Transfer::Linear, {}, {}, {}, {}},
        {"dop", "", "", SpaceKind::DoP, Transfer::Linear, {}, {}, {}, {}},
        {"dolp", "", "", SpaceKind::DoLP, Transfer::Linear, {}, {}, {}, {}},
        {"docp", "", "", SpaceKind::DoCP, Transfer::Linear, {}, {}, {}, {}},
        {"aolp", "", "", SpaceKind::AoLP, Transfer::Linear, {}, {}, {}, {}},
    }};
    return kSpaces;
}

constexpr std::string_view kCustom = "rgb:";

/// Below this area of its triangle, primaries lie on a line for all that doubles can tell: the
/// chromaticity diagram has an area of 0.3.
constexpr double kSmallestTriangle = 1e-9;

/// Chromaticities of stated primaries lie within -1 to 2 (AP0's blue has y = -0.077).
constexpr double kFarthestChromaticity = 2;

Result<OutputSpace> custom_space(std::string_view text) {
    const auto refuse = [text](const std::string& why) {
        return fail(ErrorCode::Usage, "\"" + std::string(text) + "\" " + why +
                                          "; expected rgb:xr,yr,xg,yg,xb,yb,xw,yw, such as "
                                          "rgb:0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329");
    };
    const auto pieces = split(text.substr(kCustom.size()), ',');
    std::array<double, 8> number{};
    if (pieces.size() != number.size())
        return refuse("has " + std::to_string(pieces.size()) + " numbers");
    std::vector<std::string> spelled;
    for (std::size_t i = 0; i < number.size(); ++i) {
        const auto value = parse_double(trim(pieces[i]));
        if (!value || std::abs(*value) > kFarthestChromaticity)
            return refuse("holds \"" + std::string(trim(pieces[i])) + "\", no chromaticity");
        number[i] = *value;
        spelled.push_back(format_double(*value));
    }
    OutputSpace out{std::string(kCustom) + join(spelled, ","),
                    "",
                    "",
                    SpaceKind::Rgb,
                    Transfer::Linear,
                    {number[0], number[1]},
                    {number[2], number[3]},
                    {number[4], number[5]},
                    {number[6], number[7]}};
    const Chromaticity &r = out.red, &g = out.green, &b = out.blue;
    if (out.white.x <= 0 || out.white.y <= 0)
        return refuse("has a white that is not above 0");
    const double twice_area = (g.x - r.x) * (b.y - r.y) - (b.x - r.x) * (g.y - r.y);
    if (std::abs(twice_area) < 2 * kSmallestTriangle)
        return refuse("has primaries on one line");
    // Each primary's share of the white is a triangle's area; without area that primary does nothing.
    for (const auto& [p, q] : {std::pair(r, g), std::pair(g, b), std::pair(b, r)})
        if (std::abs((q.x - p.x) * (out.white.y - p.y) - (out.white.x - p.x) * (q.y - p.y)) <
            2 * kSmallestTriangle)
            return refuse("has a white on the line between two primaries");
    return out;
}

}  // namespace

std::vector<std::string> space_outputs(SpaceKind kind) {
    switch (kind) {
    case SpaceKind::Rgb:
    case SpaceKind::Camera:
    case SpaceKind::Display: return {"R", "G", "B"};
    case SpaceKind::Luminance: return {"Y"};
    case SpaceKind::S0: return {"S0"};
    case SpaceKind::S1: return {"S1"};
    case SpaceKind::S2: return {"S2"};
    case SpaceKind::S3: return {"S3"};
    case SpaceKind::DoP: return {"DoP"};
    case SpaceKind::DoLP: return {"DoLP"};
    case SpaceKind::DoCP: return {"DoCP"};
    case SpaceKind::AoLP: return {"AoLP"};
    case SpaceKind::Lab: return {"L*", "a*", "b*"};
    case SpaceKind::Luv: return {"L*", "u*", "v*"};
    case SpaceKind::XyY: return {"x", "y", "Y"};
    case SpaceKind::Uv: return {"u'", "v'", "Y"};
    case SpaceKind::Xyz:
    case SpaceKind::XyzD65: break;
    }
    return {"X", "Y", "Z"};
}

std::span<const OutputSpace> output_spaces() {
    return spaces();
}

std::vector<std::string> output_space_names() {
    std::vector<std::string> names;
    for (const OutputSpace& space : spaces())
        names.emplace_back(space.id);
    return names;
}

Result<OutputSpace> find_output_space(std::string_view name) {
    if (to_lower(name).starts_with(kCustom))
        return custom_space(name);
    for (const OutputSpace& space : spaces()) {
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

double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
    return encoded <= 12.92 * 0.0031308 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace osio
