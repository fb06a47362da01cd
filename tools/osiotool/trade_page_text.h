// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace osio::tool {

/// The page of `trade --html`, made of the files of trade_page when the tool is built.
extern const std::string_view kTradePage;

/// What stands in it once, in the place of its data.
inline constexpr std::string_view kTradePageData = "{\"trade\": null}";

}  // namespace osio::tool
