// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <string>
#include <string_view>

namespace osio::image {

/// The value of a string, int, float or double as text that insert_typed() reads back to the same value. Nothing
/// for other types and for numbers that are not finite.
[[nodiscard]] std::optional<std::string> attribute_text(const Imf::Attribute& attribute);

/// Inserts text as an attribute of a type as OpenEXR names it. False, and nothing inserted, where the type is none of
/// those four, the text none of its values, the name empty or too long, or it is taken by another type.
bool insert_typed(std::string_view type, const std::string& name, const std::string& value,
                  Imf::Header& header);

/// Inserts text as a string; nothing where the name cannot be one or is taken.
void insert_text(const std::string& name, const std::string& value, Imf::Header& header);

}  // namespace osio::image
