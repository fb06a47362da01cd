// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/trade/page_content.h>
#include <formats/trade/table.h>

#include <cstddef>
#include <string>

namespace osio::tool {

/// A page is at most about this large.
inline constexpr std::size_t kMostPageBytes = 12'000'000;

/// What streams may take of it: base64 makes four bytes of three, and the table and the page's own text need room.
inline constexpr std::size_t kMostPageStreamBytes = (kMostPageBytes - 500'000) / 4 * 3;

/// A trade as one HTML file that needs no other: table, plot, pictures, maps and spectra. `content` is of the
/// same job and has every choice of the table.
[[nodiscard]] std::string trade_page(const image::CollapseJob& job, const trade::Table& table,
                                     const trade::PageContent& content);

}  // namespace osio::tool
