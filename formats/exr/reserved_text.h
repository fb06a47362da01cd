// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <OpenEXR/ImfHeader.h>

#include <cstddef>
#include <string>
#include <string_view>

/// Attributes whose text is known only when the pixels are written, behind the header.
namespace osio::exr {

/// Gives a header that is about to be written a string attribute of that many spaces.
void reserve_text(const std::string& name, std::size_t bytes, Imf::Header& header);

/// Writes the text into its place in a part of a complete file; the rest of the place stays spaces. Io where
/// the system refuses or the place is too small.
[[nodiscard]] Result<void> write_reserved_text(const std::string& path, std::size_t part,
                                               std::string_view name, std::string text);

}  // namespace osio::exr
