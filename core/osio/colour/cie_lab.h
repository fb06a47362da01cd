// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/colour/rgb_space.h>

/// The uniform spaces and chromaticities of CIE 15:2018, 8.2 and 7.3, in double.
///
/// Tristimulus values are relative: those of a white have Y = 1. Any finite number is allowed, negative
/// ones too: L*, a* and b* are continued below zero by the straight line that CIE 15 joins to the cube
/// root. Where a chromaticity is not defined (X = Y = Z = 0, or values that cancel in its denominator) it
/// is the white's, so that black is neutral and no finite input gives NaN.
namespace osio {

/// CIE 1976 L*, a*, b*; L* = 100 for the white.
struct Lab {
    double l = 0, a = 0, b = 0;
};

/// CIE 1976 L*, C*ab, and the hue angle hab in degrees, 0 to 360; 0 where there is no chroma.
struct Lch {
    double l = 0, c = 0, h_deg = 0;
};

/// CIE 1976 L*, u*, v*.
struct Luv {
    double l = 0, u = 0, v = 0;
};

/// CIE 1976 u', v'.
struct UniformChromaticity {
    double u = 0, v = 0;
};

[[nodiscard]] Lab lab_of(const Vector3& xyz, const Vector3& white);

/// XYZ of L*, a*, b*: the inverse of lab_of for every finite input.
[[nodiscard]] Vector3 xyz_of(const Lab& lab, const Vector3& white);

[[nodiscard]] Lch lch_of(const Lab& lab);

[[nodiscard]] Luv luv_of(const Vector3& xyz, const Vector3& white);

[[nodiscard]] Chromaticity xy_of(const Vector3& xyz, const Vector3& white);

[[nodiscard]] UniformChromaticity uv_of(const Vector3& xyz, const Vector3& white);

}  // namespace osio
