// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace osio::trade {

/// Numbers in two bytes each: the high bytes of all, then the low ones, which packs better.
struct NumberCodes {
    std::vector<std::uint8_t> bytes;
    double unit = 1;  ///< what a decoded code is multiplied by
};

/// Differences as whole multiples of the unit, rounded up, so that only 0 is 0: the largest is 65534 units, others are
/// too large by less than a unit. 65535 stands for NaN and infinity.
[[nodiscard]] NumberCodes codes_of_differences(std::span<const float> values);

/// Samples as IEEE 754 binary16 times the unit, a power of two that brings the largest magnitude between 2^14 and 2^15:
/// halves stay what they are, and floats lose at most 2^-11 of themselves, or 2^-39 of the largest.
[[nodiscard]] NumberCodes codes_of_samples(std::span<const float> values);

}  // namespace osio::trade
