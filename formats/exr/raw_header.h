// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace osio::exr {

/// Where an attribute lies in a file; the views point into the bytes that were parsed.
struct RawAttribute {
    std::string_view name;
    std::string_view type;
    std::string_view value;
    std::size_t value_at = 0;  ///< bytes from the start of the file
};

using RawHeader = std::vector<RawAttribute>;

/// The headers of a file as bytes, before anything is made of them (OpenEXR's "File Layout").
struct RawHeaders {
    std::string_view version;  ///< the four bytes after the magic number: version and flags
    bool multi_part = false;
    std::vector<RawHeader> parts;
    std::size_t end = 0;  ///< where the tables of chunks start
};

/// Parses the start of a file of `file_bytes`. Nothing where `bytes` ends before the headers do, though
/// the file goes on; Damaged where the headers contradict themselves, the file's length or our limits.
[[nodiscard]] Result<std::optional<RawHeaders>> parse_raw_headers(std::string_view bytes,
                                                                  std::uint64_t file_bytes);

/// An unsigned number of `width` bytes, the lowest first, as OpenEXR stores numbers.
[[nodiscard]] constexpr std::uint64_t little_endian(std::string_view bytes, std::size_t at,
                                                    std::size_t width) {
    std::uint64_t value = 0;
    for (std::size_t i = width; i-- > 0;)
        value = value << 8U | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
}

}  // namespace osio::exr
