// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/pixel_stage.h>
#include <osio/colour/cie_lab.h>

namespace osio {

Vector3 PixelStage::convert(const Vector3& linear) const {
    switch (m_space.kind) {
    case SpaceKind::Lab: {
        const Lab lab = lab_of(linear, m_white);
        return {lab.l, lab.a, lab.b};
    }
    case SpaceKind::Luv: {
        const Luv luv = luv_of(linear, m_white);
        return {luv.l, luv.u, luv.v};
    }
    case SpaceKind::XyY: {
        const Chromaticity xy = xy_of(linear, m_white);
        return {xy.x, xy.y, linear[1]};
    }
    case SpaceKind::Uv: {
        const UniformChromaticity uv = uv_of(linear, m_white);
        return {uv.u, uv.v, linear[1]};
    }
    default: break;
    }
    if (m_space.transfer == Transfer::Srgb)
        return {srgb_encode(linear[0]), srgb_encode(linear[1]), srgb_encode(linear[2])};
    return linear;
}

void PixelStage::apply(std::span<float* const, 3> planes, const float* alpha, std::size_t pixels) const {
    if (m_space.transform) {
        transform(planes, alpha, pixels);
        return;
    }
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const double share = alpha != nullptr && alpha[pixel] > 0 ? static_cast<double>(alpha[pixel]) : 1;
        Vector3 linear{};
        for (std::size_t c = 0; c < 3; ++c)
            linear[c] = static_cast<double>(planes[c][pixel]) / share;
        const Vector3 out = convert(linear);
        for (std::size_t c = 0; c < 3; ++c)
            planes[c][pixel] = static_cast<float>(out[c] * share);
    }
}

void PixelStage::transform(std::span<float* const, 3> planes, const float* alpha, std::size_t pixels) const {
    const bool associated = alpha != nullptr && !m_space.transform->is_linear();
    if (associated)
        for (float* const plane : planes)
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                plane[pixel] /= alpha[pixel] > 0 ? alpha[pixel] : 1.0F;
    m_space.transform->apply(planes, pixels);
    if (associated)
        for (float* const plane : planes)
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                plane[pixel] *= alpha[pixel] > 0 ? alpha[pixel] : 1.0F;
}

}  // namespace osio
