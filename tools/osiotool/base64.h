// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace osio::tool {

/// Bytes as text by the alphabet of RFC 4648, 4, padded.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace osio::tool
