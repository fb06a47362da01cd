// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/number_codes.h>

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

namespace osio::trade {

namespace {

constexpr double kMostUnits = 65534;
constexpr long kUndefinedCode = 65535;

/// The largest finite magnitude.
double largest_of(std::span<const float> values) {
    float out = 0;
    for (const float value : values)
        if (std::isfinite(value))
            out = std::max(out, std::abs(value));
    return static_cast<double>(out);
}

template <class Code>
std::vector<std::uint8_t> bytes_of(std::span<const float> values, Code code) {
    std::vector<std::uint8_t> out(2 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto bits = static_cast<unsigned>(code(values[i]));
        out[i] = static_cast<std::uint8_t>(bits >> 8);
        out[values.size() + i] = static_cast<std::uint8_t>(bits & 0xFFU);
    }
    return out;
}

}  // namespace

NumberCodes codes_of_differences(std::span<const float> values) {
    const double largest = largest_of(values), unit = largest > 0 ? largest / kMostUnits : 1;
    const auto code = [unit](float value) {
        if (!std::isfinite(value))
            return kUndefinedCode;
        return std::lround(std::min(kMostUnits, std::ceil(static_cast<double>(value) / unit)));
    };
    return {bytes_of(values, code), unit};
}

NumberCodes codes_of_samples(std::span<const float> values) {
    const double largest = largest_of(values);
    const int power = largest > 0 ? std::ilogb(largest) - 14 : 0;
    const auto code = [power](float value) {
        return Imath::half(static_cast<float>(std::scalbn(static_cast<double>(value), -power))).bits();
    };
    return {bytes_of(values, code), std::scalbn(1.0, power)};
}

}  // namespace osio::trade
