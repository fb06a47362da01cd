// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/cie_lab.h>

#include <cmath>
#include <numbers>

namespace osio {

namespace {

/// CIE 15:2018, 8.2.1: f(t) is the cube root above (6/29)^3 and below it a line that meets it there
/// with the same slope, f(t) = (841/108) t + 4/29.
constexpr double kJoin = 6.0 / 29.0;
constexpr double kSlope = 841.0 / 108.0;
constexpr double kOffset = 4.0 / 29.0;

double cube_root_or_line(double t) {
    return t > kJoin * kJoin * kJoin ? std::cbrt(t) : kSlope * t + kOffset;
}

double inverse_of_it(double f) {
    return f > kJoin ? f * f * f : (f - kOffset) / kSlope;
}

double lightness(double relative_y) {
    return 116 * cube_root_or_line(relative_y) - 16;
}

}  // namespace

Lab lab_of(const Vector3& xyz, const Vector3& white) {
    const double fx = cube_root_or_line(xyz[0] / white[0]);
    const double fy = cube_root_or_line(xyz[1] / white[1]);
    const double fz = cube_root_or_line(xyz[2] / white[2]);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Vector3 xyz_of(const Lab& lab, const Vector3& white) {
    const double fy = (lab.l + 16) / 116;
    return {white[0] * inverse_of_it(fy + lab.a / 500), white[1] * inverse_of_it(fy),
            white[2] * inverse_of_it(fy - lab.b / 200)};
}

Lch lch_of(const Lab& lab) {
    const double h = std::atan2(lab.b, lab.a) * 180 / std::numbers::pi;
    return {lab.l, std::hypot(lab.a, lab.b), h < 0 ? h + 360 : h};
}

UniformChromaticity uv_of(const Vector3& xyz, const Vector3& white) {
    const double below = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
    if (below == 0)
        return xyz == white ? UniformChromaticity{} : uv_of(white, white);
    return {4 * xyz[0] / below, 9 * xyz[1] / below};
}

Luv luv_of(const Vector3& xyz, const Vector3& white) {
    const double l = lightness(xyz[1] / white[1]);
    const UniformChromaticity colour = uv_of(xyz, white), neutral = uv_of(white, white);
    return {l, 13 * l * (colour.u - neutral.u), 13 * l * (colour.v - neutral.v)};
}

Chromaticity xy_of(const Vector3& xyz, const Vector3& white) {
    const double sum = xyz[0] + xyz[1] + xyz[2];
    if (sum == 0)
        return xyz == white ? Chromaticity{} : xy_of(white, white);
    return {xyz[0] / sum, xyz[1] / sum};
}

}  // namespace osio
