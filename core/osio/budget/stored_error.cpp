// SPDX-License-Identifier: Apache-2.0
#include <osio/budget/stored_error.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace osio {

namespace {

constexpr float kLargestHalf = 65504;

/// Half the distance of the halves around a value.
float half_unit(float magnitude) {
    const auto binade = std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) & 0x7F800000U);
    return std::max(0x1p-25F, 0x1p-11F * binade);
}

}  // namespace

bool StoredError::clamps(float sum) const {
    const auto encoded =
        m_transfer == Transfer::Linear ? sum : static_cast<float>(srgb_encode(static_cast<double>(sum)));
    switch (m_depth) {
    case StoredDepth::Float: return false;
    case StoredDepth::Half: return std::abs(encoded) > kLargestHalf;
    case StoredDepth::Uint8:
    case StoredDepth::Uint16: break;
    }
    return encoded < 0 || encoded > 1;
}

double StoredError::of_stored(double value) const {
    const double magnitude = std::abs(value);
    switch (m_depth) {
    case StoredDepth::Float: return 0;
    case StoredDepth::Half:
        return magnitude > static_cast<double>(kLargestHalf)
                   ? magnitude - static_cast<double>(kLargestHalf)
                   : static_cast<double>(half_unit(static_cast<float>(magnitude)));
    case StoredDepth::Uint8:
    case StoredDepth::Uint16: break;
    }
    const double outside = value < 0 ? -value : value > 1 ? value - 1 : 0;
    return outside + 0.5 / (m_depth == StoredDepth::Uint8 ? 255 : 65535);
}

double StoredError::of_encoded(double linear) const {
    const double encoded = srgb_encode(linear);
    // The curve in double, and its result as the float that is stored or quantised.
    const double error = of_stored(encoded) + std::abs(encoded) * 0x1p-23;
    return std::max(std::abs(srgb_decode(encoded + error) - linear),
                    std::abs(linear - srgb_decode(encoded - error)));
}

float StoredError::of(float sum) const {
    if (m_depth == StoredDepth::Half && m_transfer == Transfer::Linear)
        return std::max(half_unit(std::min(std::abs(sum), kLargestHalf)), std::abs(sum) - kLargestHalf);
    const double linear = static_cast<double>(sum);
    const double error = m_transfer == Transfer::Linear ? of_stored(linear) : of_encoded(linear);
    return static_cast<float>(error * (1 + 0x1p-23));
}

}  // namespace osio
