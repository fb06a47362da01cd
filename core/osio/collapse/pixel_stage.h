// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/colour/rgb_space.h>

#include <cstddef>
#include <span>

namespace osio {

/// What a space adds to the sums over bands, pixel by pixel: sRGB's curve, the way from XYZ to Lab,
/// Luv, xyY or u'v'Y, or a colour config's transform. Nothing for linear spaces of our own; degrees and
/// angles of polarisation have polarise().
class PixelStage {
  public:
    /// `white`: XYZ that Lab, Luv and chromaticities refer to.
    PixelStage(const OutputSpace& space, const Vector3& white) : m_space(space), m_white(white) {}

    [[nodiscard]] bool needed() const {
        return m_space.transform || m_space.transfer != Transfer::Linear ||
               (!is_tristimulus(m_space.kind) && !is_polarisation(m_space.kind));
    }

    /// True where a negative value of the space lies outside what is real: not so in Lab and Luv, of Stokes
    /// components with a sign, and of an angle.
    [[nodiscard]] bool negative_is_outside() const {
        switch (m_space.kind) {
        case SpaceKind::Lab:
        case SpaceKind::Luv:
        case SpaceKind::S1:
        case SpaceKind::S2:
        case SpaceKind::S3:
        case SpaceKind::AoLP: return false;
        default: return true;
        }
    }

    /// One pixel of unassociated colour, in a space of our own.
    [[nodiscard]] Vector3 convert(const Vector3& linear) const;

    /// Converts three planes in place. Where `alpha` is not null, colour is associated with it: it is
    /// divided by alpha, converted and multiplied again; alpha of 0 or below, and a config's transform
    /// that is linear, leave it as it is.
    void apply(std::span<float* const, 3> planes, const float* alpha, std::size_t pixels) const;

  private:
    void transform(std::span<float* const, 3> planes, const float* alpha, std::size_t pixels) const;

    OutputSpace m_space;
    Vector3 m_white;
};

}  // namespace osio
