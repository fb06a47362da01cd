// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/json_text.h>

#include <formats/trade/table.h>

#include <string>

namespace osio::tool {

/// What trade_json() is the text of.
[[nodiscard]] Json trade_object(const std::string& input, const trade::Table& table);

}  // namespace osio::tool
