// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>

#include <string_view>

namespace osio {

/// How colours seen under one white are carried to another: by scaling some linear responses.
enum class Adaptation {
    None,        ///< not at all
    XyzScaling,  ///< X, Y and Z themselves, each on its own
    VonKries,    ///< Hunt-Pointer-Estevez cones, normalised to D65 (Hunt, The Reproduction of Colour)
    Bradford,    ///< Lam 1985, as in ICC.1:2022, annex E
    Cat02,       ///< CIECAM02, CIE 159:2004
    Cat16,       ///< CAM16, CIE 248:2022
};

/// Responses of XYZ that an adaptation scales; the identity for None and XyzScaling.
[[nodiscard]] Matrix3 response_matrix(Adaptation adaptation);

/// XYZ under `to_white` of XYZ under `from_white`: responses times to/from, complete adaptation. The
/// identity, exactly, for None and for equal whites. InvalidGrid where a response to `from_white` is
/// zero, as the blue one is to a deep red lamp: there is nothing to scale. A negative response
/// (saturated lamps have such) is carried as it is: white still becomes white.
[[nodiscard]] Result<Matrix3> adaptation_matrix(Adaptation adaptation, const Vector3& from_white,
                                                const Vector3& to_white);

/// "none", "xyz-scaling", "von-kries", "bradford", "cat02", "cat16".
[[nodiscard]] std::string_view adaptation_name(Adaptation adaptation);

/// The adaptation of that name (case ignored). UnknownName names the nearest.
[[nodiscard]] Result<Adaptation> find_adaptation(std::string_view name);

}  // namespace osio
