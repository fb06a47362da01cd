// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/raw_file.h>

#include <osio/base/result.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace osio::stack {

/// What the header of a PNG file says.
struct PngHeader {
    std::uint32_t width = 0, height = 0;
    int bits = 8;          ///< of a sample: 8 or 16
    int channels = 1;      ///< 1 grey, 2 with alpha, 3 RGB, 4 with alpha
    bool encoded = false;  ///< it says that its numbers are encoded for a display (gAMA, sRGB, iCCP)
    std::vector<std::string> warnings;
};

/// Damaged where it is broken or its sizes exceed formats/image/limits.h; Unsupported for palettes and samples of
/// fewer than 8 bits.
[[nodiscard]] Result<PngHeader> read_png_header(const files::RawFile& file);

/// Its grey samples, row after row, big-endian where they have 16 bits; those of alpha are left out. Damaged where
/// the file is broken or libpng has a word to say about its pixels; Unsupported where R, G and B differ.
[[nodiscard]] Result<std::vector<std::byte>> read_png_grey(const files::RawFile& file,
                                                           const PngHeader& header);

}  // namespace osio::stack
