// SPDX-License-Identifier: Apache-2.0
#include <osio/budget/stored_error.h>

#include <cmath>

namespace osio {

namespace {

constexpr double kLargestHalf = 65504;

/// Half the distance of the halves around a value.
double half_unit(double magnitude) {
    return magnitude < 0x1p-14 ? 0x1p-25 : std::exp2(std::ilogb(magnitude)) * 0x1p-11;
}

}  // namespace

double StoredError::of_stored(double value, bool& clamped) const {
    const double magnitude = std::abs(value);
    switch (m_depth) {
    case StoredDepth::Float: return m_transfer == Transfer::Linear ? 0 : magnitude * 0x1p-24 + 0x1p-150;
    case StoredDepth::Half:
        if (magnitude > kLargestHalf) {
            clamped = true;
            return magnitude - kLargestHalf;
        }
        return half_unit(magnitude);
    case StoredDepth::Uint8:
    case StoredDepth::Uint16: break;
    }
    const double largest = m_depth == StoredDepth::Uint8 ? 255 : 65535;
    const double outside = value < 0 ? -value : value > 1 ? value - 1 : 0;
    clamped = clamped || outside > 0;
    return outside + 0.5 / largest;
}

double StoredError::of(float sum, bool& clamped) const {
    const double linear = static_cast<double>(sum);
    if (m_transfer == Transfer::Linear)
        return of_stored(linear, clamped);
    const double encoded = srgb_encode(linear);
    // The curve in double, and its result as the float that is stored or quantised.
    const double error = of_stored(encoded, clamped) + std::abs(encoded) * 0x1p-23;
    return std::max(std::abs(srgb_decode(encoded + error) - linear),
                    std::abs(linear - srgb_decode(encoded - error)));
}

}  // namespace osio
