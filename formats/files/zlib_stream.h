// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace osio::files {

/// The bytes as a zlib stream (RFC 1950). Throws std::bad_alloc.
[[nodiscard]] std::string zlib_stream_of(std::span<const std::uint8_t> bytes);

}  // namespace osio::files
