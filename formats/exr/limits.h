// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/limits.h>

/// The limits that OpenEXR's structure has beside those of every format.
namespace osio::exr {

/// Bytes of all headers of a file together.
inline constexpr std::uint64_t kMostHeaderBytes = std::uint64_t{1} << 28;

/// Parts of a file.
inline constexpr std::size_t kMostParts = 4096;

/// Unpacked bytes of a chunk or tile: OpenEXR counts them in 31 bits.
inline constexpr std::uint64_t kMostChunkBytes = (std::uint64_t{1} << 31) - 1;

/// What a file of any size may ask for; beyond it, a file must be large enough to hold what it claims
/// (most_expansion()).
inline constexpr std::uint64_t kFreeBytes = std::uint64_t{1} << 26;

}  // namespace osio::exr
