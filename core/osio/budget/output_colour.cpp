// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/budget/output_colour.h>

namespace osio {

namespace {

/// XYZ of the space's own white, Y = 1.
Vector3 white_of(const CollapsePlan& plan) {
    switch (plan.space.kind) {
    case SpaceKind::XyzD65: return kD65.xyz();
    case SpaceKind::Rgb:
    case SpaceKind::Display: return plan.space.white.xyz();
    default: return plan.white;
    }
}

}  // namespace

Result<OutputColour> output_colour(const CollapsePlan& plan, double white_luminance) {
    const SpaceKind kind = plan.space.kind;
    if (plan.space.transform || !is_tristimulus(kind) || is_polarimetric(kind) || kind == SpaceKind::Camera)
        return fail(ErrorCode::Usage,
                    "the error of to=" + plan.space.id +
                        " is not bounded: expected a space whose numbers are sums over bands and have an "
                        "XYZ, such as xyz, luminance, lin_rec709 or srgb");
    if (kind == SpaceKind::Luminance)
        return OutputColour{
            Matrix3{
                {{{1 / white_luminance, 0, 0}, {1 / white_luminance, 0, 0}, {1 / white_luminance, 0, 0}}}},
            true,
            {}};
    const Vector3 white = white_of(plan);
    if (!(white[0] > 0 && white[2] > 0))
        return fail(ErrorCode::InvalidGrid,
                    "the white has X " + format_double(white[0]) + " and Z " + format_double(white[2]) +
                        ", so no colour difference can refer to it; name another with white=");
    const Matrix3 share =
        Matrix3::diagonal({1 / (white[0] * white_luminance), 1 / (white[1] * white_luminance),
                           1 / (white[2] * white_luminance)});
    const bool rgb = kind == SpaceKind::Rgb || kind == SpaceKind::Display;
    return OutputColour{rgb ? share * xyz_from_rgb(plan.space) : share, false, white};
}

}  // namespace osio
