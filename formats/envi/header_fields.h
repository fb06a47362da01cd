// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <string>
#include <string_view>
#include <vector>

namespace osio::envi {

/// One `key = value` of a header.
struct Field {
    std::string key;    ///< in lower case, words one space apart, '_' read as a space
    std::string label;  ///< the key as it is written
    std::string value;  ///< of a list what is between its braces, as it is written
    bool list = false;
};

/// The fields of a header in their order, and what was odd.
struct HeaderFields {
    std::vector<Field> fields;
    std::vector<std::string> warnings;

    /// The field of that key, or null.
    [[nodiscard]] const Field* find(std::string_view key) const;
};

/// A key in lower case, its words one space apart: "Data_Type" is "data type".
[[nodiscard]] std::string normal_key(std::string_view label);

/// True where text starts as ENVI headers do: a first line that is the word ENVI. Radiance pictures start
/// with #?, headers of ESRI grids with a key.
[[nodiscard]] bool starts_like_envi(std::string_view text);

/// Reads the grammar of a header:
///
///     ENVI
///     ; comment
///     key = value
///     key = { value, over
///             several lines }
///
/// Square brackets and a byte order mark are taken too. Lines that are none of these are left out with a
/// warning; of a key that comes twice the last counts, with a warning. NotSpectral where the first line is
/// not ENVI, Damaged where a brace is never closed.
[[nodiscard]] Result<HeaderFields> parse_fields(std::string_view text);

/// The pieces of a list between its commas, without white space around them and without empty pieces at
/// either end.
[[nodiscard]] std::vector<std::string_view> list_items(std::string_view value);

}  // namespace osio::envi
