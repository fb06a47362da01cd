// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Text without a locale: numbers always have a point, letters are ASCII.
namespace osio {

/// `text` without ASCII white space at either end.
[[nodiscard]] std::string_view trim(std::string_view text);

/// Equal up to the case of ASCII letters.
[[nodiscard]] bool iequals(std::string_view a, std::string_view b);

/// Text as XML takes it, in elements and attributes.
[[nodiscard]] std::string escaped_xml(std::string_view text);

/// ASCII letters in lower case, all else as it is.
[[nodiscard]] std::string to_lower(std::string_view text);

/// The pieces between separators; always one more than there are separators.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// The pieces with `separator` between them.
[[nodiscard]] std::string join(std::span<const std::string> pieces, std::string_view separator);

/// The whole of `text` as a finite decimal number with a point, or nothing. A leading '+' is
/// accepted, white space, infinities, NaN and out-of-range magnitudes are not.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);

/// The whole of `text` as a decimal integer, or nothing.
[[nodiscard]] std::optional<int> parse_int(std::string_view text);

/// The shortest decimal that reads back as the same double, never in exponent form between 1e-5
/// and 1e15.
[[nodiscard]] std::string format_double(double value);

/// `value` rounded to `digits` places after the point, for people.
[[nodiscard]] std::string format_fixed(double value, int digits);

/// The candidate with the smallest edit distance to `text` (case ignored), or nothing when even
/// that differs in more than a third of its letters: a wild guess helps nobody.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view text,
                                                      std::span<const std::string> candidates);

/// `; did you mean "x"?` for the nearest candidate, or the whole list when it is short, or nothing.
[[nodiscard]] std::string suggestion(std::string_view text, std::span<const std::string> candidates);

}  // namespace osio
