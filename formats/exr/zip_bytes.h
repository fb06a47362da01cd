// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// The order of bytes that OpenEXR's ZIP and ZIPS give to zlib. The samples' bytes b[0..n), n even as
/// every sample has 2 or 4 bytes, are split into the bytes at even places, then those at odd ones; of
/// the result t each byte but the first is replaced by its difference from the one before:
///
///     t = b[0] b[2] .. b[n-2] b[1] b[3] .. b[n-1]        d[i] = t[i] - t[i-1] + 128 (mod 256)
///
/// with t[-1] = 128. (OpenEXR's file layout, "ZIP compression"; src/lib/OpenEXR/ImfZip.cpp.)
namespace osio::exr {

/// Undoing of a chunk, front to back. Both halves advance together, so that a line is whole samples as
/// soon as it is reached, and is used while it is in the cache.
struct UnzipCursor {
    const std::uint8_t* even = nullptr;  ///< the next difference of either half
    const std::uint8_t* odd = nullptr;
    std::uint8_t even_before = 128;  ///< t before them
    std::uint8_t odd_before = 128;
};

/// At the start of `zipped`, whose size is even.
[[nodiscard]] UnzipCursor start_unzip(std::span<const std::uint8_t> zipped);
[[nodiscard]] UnzipCursor start_unzip_reference(std::span<const std::uint8_t> zipped);

/// The next `out.size()` bytes, an even number.
void unzip(UnzipCursor& cursor, std::span<std::uint8_t> out);
void unzip_reference(UnzipCursor& cursor, std::span<std::uint8_t> out);

/// All of `bytes`, an even number, in the order for zlib; `out` is as large and does not overlap.
void zip(std::span<const std::uint8_t> bytes, std::uint8_t* out);
void zip_reference(std::span<const std::uint8_t> bytes, std::uint8_t* out);

}  // namespace osio::exr
