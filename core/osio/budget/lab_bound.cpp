// SPDX-License-Identifier: Apache-2.0
#include <osio/budget/lab_bound.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace osio {

namespace {

constexpr double kLineEnd = 216.0 / 24389;  // (6/29)^3
constexpr double kLineSlope = 841.0 / 108;  // (29/6)^2 / 3

}  // namespace

std::size_t LabSlope::index_of(float t) {
    return (std::bit_cast<std::uint32_t>(t) - std::bit_cast<std::uint32_t>(kFirst)) >> kDroppedBits;
}

LabSlope::LabSlope() {
    for (std::size_t i = 0; i < m_slopes.size(); ++i) {
        // The slope falls, so that of a bucket's lower end holds for all of it; a float may round it down.
        const auto low = std::bit_cast<float>(std::bit_cast<std::uint32_t>(kFirst) +
                                              (static_cast<std::uint32_t>(i) << kDroppedBits));
        const double t = static_cast<double>(low);
        const double slope = t <= kLineEnd ? kLineSlope : 1 / (3 * std::cbrt(t) * std::cbrt(t));
        m_slopes[i] = static_cast<float>(slope * (1 + 0x1p-22));
    }
    m_slopes[0] = static_cast<float>(kLineSlope * (1 + 0x1p-22));
}

}  // namespace osio
