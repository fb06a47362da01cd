// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/header_fields.h>

#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <string>

namespace osio::envi {

/// Prefix of the names under which a header's own fields are attributes: `envi:sensor type`.
inline constexpr std::string_view kAttributePrefix = "envi:";

/// An attribute as a field of a header: one whose name starts with `envi:` under that key, a string, int, float
/// or double of another name as `exr TYPE NAME`. Nothing for other types, and for text that the grammar cannot
/// hold ('}', or '=' in a name), and for numbers that are not finite.
[[nodiscard]] std::optional<Field> field_of(const std::string& name, const Imf::Attribute& attribute);

/// Inserts a field as the attribute it came from, `exr TYPE NAME` under its name and type, all others as strings.
void insert_field(const Field& field, Imf::Header& header);

/// True for keys whose lists count the bands as they are: of other bands they are not true.
[[nodiscard]] bool counts_bands(std::string_view key);

}  // namespace osio::envi
