// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace osio::tool {

/// Keys in the order in which they are set.
using Json = nlohmann::ordered_json;

/// A report's text. Text from files may hold bytes that are no UTF-8; they are replaced rather than refused.
[[nodiscard]] inline std::string dump(const Json& json) {
    constexpr int kIndent = 2;
    return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace osio::tool
