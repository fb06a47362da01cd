// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/trade/table.h>

#include <string>

namespace osio::tool {

/// A trade's table for people, for programs, and for spreadsheets.
[[nodiscard]] std::string trade_text(const std::string& input, const trade::Table& table);
[[nodiscard]] std::string trade_json(const std::string& input, const trade::Table& table);
[[nodiscard]] std::string trade_csv(const trade::Table& table);

/// "same" where noise hides the difference of an offer's time to that of the exact collapse, else their ratio.
[[nodiscard]] std::string time_against_exact(const trade::Table& table, const trade::Offer& offer);

}  // namespace osio::tool
