// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>

#include <cstddef>
#include <span>

namespace osio {

/// CIEDE2000 between two runs of pixels, X, Y, Z in planes as floats, under one white: 0 where all three are equal,
/// NaN where the original has no colour (NaN or infinite), infinite where only the other has none.
void colour_differences(std::span<const float* const> original, std::span<const float* const> other,
                        const Vector3& white, std::size_t count, std::span<double> out);

}  // namespace osio
