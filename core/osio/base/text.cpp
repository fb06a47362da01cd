// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace osio {

namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Edit distance that counts two swapped neighbours as one error (optimal string alignment): most
/// typing errors are of that kind.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    const std::size_t width = b.size() + 1;
    std::vector<std::size_t> d((a.size() + 1) * width);
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            std::size_t& cell = d[i * width + j];
            if (i == 0 || j == 0) {
                cell = i + j;
                continue;
            }
            const auto same = [&](std::size_t x, std::size_t y) { return lower(a[x]) == lower(b[y]); };
            cell = std::min({d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1,
                             d[(i - 1) * width + j - 1] + (same(i - 1, j - 1) ? 0 : 1)});
            if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
                cell = std::min(cell, d[(i - 2) * width + j - 2] + 1);
        }
    }
    return d.back();
}

}  // namespace

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

bool iequals(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

std::string escaped_xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        default: out += c;
        }
    }
    return out;
}

std::string to_lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), lower);
    return out;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> pieces;
    for (;;) {
        const auto at = text.find(separator);
        pieces.push_back(text.substr(0, at));
        if (at == std::string_view::npos)
            return pieces;
        text.remove_prefix(at + 1);
    }
}

std::string join(std::span<const std::string> pieces, std::string_view separator) {
    std::string out;
    for (const std::string& piece : pieces) {
        if (!out.empty())
            out += separator;
        out += piece;
    }
    return out;
}

std::optional<double> parse_double(std::string_view text) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-'))
            return std::nullopt;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<int> parse_int(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

std::string format_double(double value) {
    std::array<char, 64> buffer{};
    const double magnitude = std::abs(value);
    const bool plain = value == 0 || (magnitude >= 1e-5 && magnitude < 1e15);
    const auto result =
        plain ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed)
              : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

std::string format_fixed(double value, int digits) {
    std::array<char, 400> buffer{};
    const auto result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, digits);
    return {buffer.data(), result.ptr};
}

std::optional<std::string> nearest_name(std::string_view text, std::span<const std::string> candidates) {
    const auto closer = [text](const std::string& a, const std::string& b) {
        return edit_distance(text, a) < edit_distance(text, b);
    };
    const auto best = std::min_element(candidates.begin(), candidates.end(), closer);
    if (best == candidates.end())
        return std::nullopt;
    const std::size_t allowed = std::max<std::size_t>(1, std::max(text.size(), best->size()) / 3);
    if (edit_distance(text, *best) > allowed)
        return std::nullopt;
    return *best;
}

std::string suggestion(std::string_view text, std::span<const std::string> candidates) {
    constexpr std::size_t kShortList = 12;
    if (const auto nearest = nearest_name(text, candidates))
        return "; did you mean \"" + *nearest + "\"?";
    if (!candidates.empty() && candidates.size() <= kShortList)
        return "; known are " + join(candidates, ", ");
    return {};
}

}  // namespace osio
