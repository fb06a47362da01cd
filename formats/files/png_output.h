// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <cstdint>
#include <span>
#include <string>

namespace osio::files {

/// The bytes of a PNG file of 8 bits a sample that says it is sRGB. `samples`: red, green, blue, row after row,
/// 3 x width of them in a row. Io where libpng has no memory.
[[nodiscard]] Result<std::string> png_of_srgb(std::span<const std::uint8_t> samples, std::size_t width);

}  // namespace osio::files
