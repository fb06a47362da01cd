// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The limits of our own on what a file may ask for, checked before anything is allocated. Nothing of
/// OpenEXR or OpenImageIO is set: what is global there belongs to the host.
namespace osio::exr {

/// Channels of a part: 4 x 16384 bands of four Stokes components.
inline constexpr std::size_t kMostChannels = 65536;

/// Bytes of the name of a channel or attribute, and of a type: OpenEXR's own limit for long names.
inline constexpr std::size_t kMostNameBytes = 255;

/// Bytes of all headers of a file together.
inline constexpr std::uint64_t kMostHeaderBytes = std::uint64_t{1} << 28;

/// Parts of a file.
inline constexpr std::size_t kMostParts = 4096;

/// Pixels across and down: OpenEXR's own arithmetic on windows is in 32 bits with a sign.
inline constexpr std::int64_t kMostSidePixels = (std::int64_t{1} << 30) - 1;

/// Unpacked bytes of a chunk or tile: OpenEXR counts them in 31 bits.
inline constexpr std::uint64_t kMostChunkBytes = (std::uint64_t{1} << 31) - 1;

/// Unpacked bytes that a worker holds at once: a row of chunks.
inline constexpr std::uint64_t kMostBlockBytes = std::uint64_t{1} << 32;

/// Unpacked bytes of a part.
inline constexpr std::uint64_t kMostPartBytes = std::uint64_t{1} << 46;

/// What a file of any size may ask for; beyond it, a file must be large enough to hold what it claims
/// (most_expansion()).
inline constexpr std::uint64_t kFreeBytes = std::uint64_t{1} << 26;

}  // namespace osio::exr
