// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/raw_header.h>

#include <OpenEXR/ImfAttribute.h>
#include <OpenEXR/ImfHeader.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The checksum that our writer leaves in a file, over bytes as they are stored: one for each chunk and
/// one for the header. So it covers every compression, the lossy ones too, is checked by whoever reads
/// any one chunk, and names the chunk that is damaged.
namespace osio::exr {

namespace attribute {
inline constexpr const char* kChecksum = "spectral:checksum";
/// A type of its own: programs that copy what they know leave the attribute out of what they write.
inline constexpr const char* kChecksumType = "spectralChecksum";
}  // namespace attribute

/// What the attribute holds: 24 bytes and 8 for each chunk, numbers with the lowest byte first.
struct Checksum {
    std::uint64_t file_bytes = 0;       ///< the file it belongs to has this length
    std::uint64_t header = 0;           ///< header_checksum()
    std::vector<std::uint64_t> chunks;  ///< chunk_checksum(), in the order of the table of chunks

    /// Nothing where the bytes are no checksum of this version.
    [[nodiscard]] static std::optional<Checksum> parse(std::string_view value);
    [[nodiscard]] std::string bytes() const;
};

/// XXH3, 64 bits (Y. Collet, xxHash 0.8), of a chunk with its own header.
[[nodiscard]] std::uint64_t chunk_checksum(std::string_view stored);

/// The same over the header's version and the attributes that decide what pixels are and mean: structure,
/// windows, chromaticities, everything spectral. Names, comments, time codes may be edited in place.
[[nodiscard]] std::uint64_t header_checksum(std::string_view version, const RawHeader& header);

/// The checksum's attribute in a header; null where there is none.
[[nodiscard]] const RawAttribute* find_checksum(const RawHeader& header);

/// Reserves the attribute's place in a header that is about to be written.
void reserve_checksum(std::size_t chunk_count, Imf::Header& header);

/// Computes the checksums of a complete file, one a part, and writes them into their places. `path` is a
/// file of flat parts, of scanlines or tiles of one level, that reserve_checksum() prepared.
[[nodiscard]] Result<void> write_checksum(const std::string& path);

}  // namespace osio::exr
