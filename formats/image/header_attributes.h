// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/dialect.h>

#include <OpenEXR/ImfHeader.h>

#include <functional>
#include <set>
#include <string>

namespace osio::image {

/// A header's texts, and its floats and doubles as the shortest decimals that read back as the same.
[[nodiscard]] HeaderAttributes header_attributes(const Imf::Header& header);

/// Takes attributes out of a header; names that it lacks are passed over. Those that every header has, such as
/// "channels", stay. (OpenEXR 3.1.5's Header::erase() never frees what it takes out.)
void erase_attributes(const std::set<std::string, std::less<>>& names, Imf::Header& header);

}  // namespace osio::image
