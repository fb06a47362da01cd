// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The limits of our own on what a file of any format may ask for, checked before anything is allocated.
/// Nothing of OpenEXR or OpenImageIO is set: what is global there belongs to the host.
namespace osio::image {

/// Channels of a part: 4 x 16384 bands of four Stokes components.
inline constexpr std::size_t kMostChannels = 65536;

/// Bytes of the name of a channel or attribute, and of a type: OpenEXR's own limit for long names.
inline constexpr std::size_t kMostNameBytes = 255;

/// Pixels across and down: OpenEXR's own arithmetic on windows is in 32 bits with a sign.
inline constexpr std::int64_t kMostSidePixels = (std::int64_t{1} << 30) - 1;

/// Unpacked bytes that a worker holds at once: a row of chunks.
inline constexpr std::uint64_t kMostBlockBytes = std::uint64_t{1} << 32;

/// Unpacked bytes of a part.
inline constexpr std::uint64_t kMostPartBytes = std::uint64_t{1} << 46;

}  // namespace osio::image
