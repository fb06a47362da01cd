// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/header_fields.h>

#include <osio/base/text.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace osio::envi {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// As much of an odd line as a warning shows.
constexpr std::size_t kShownBytes = 40;

/// Lines of a text, with a place in it.
class Lines {
  public:
    explicit Lines(std::string_view text) : m_text(text) {}

    [[nodiscard]] bool at_end() const { return m_at >= m_text.size(); }

    [[nodiscard]] int number() const { return m_number; }

    /// The next line without its end.
    std::string_view next() {
        const auto end = std::min(m_text.find('\n', m_at), m_text.size());
        const std::string_view line = m_text.substr(m_at, end - m_at);
        m_at = end + 1;
        ++m_number;
        return line;
    }

    /// From a place in the line that was read last up to a character, which may be lines further on;
    /// nothing where it never comes. The rest of that line is skipped.
    std::optional<std::string_view> take_until(std::string_view from, char end) {
        const auto start = static_cast<std::size_t>(from.data() - m_text.data());
        const auto found = m_text.find(end, start);
        if (found == std::string_view::npos)
            return std::nullopt;
        const std::string_view out = m_text.substr(start, found - start);
        m_number += static_cast<int>(std::count(out.begin(), out.end(), '\n'));
        m_at = std::min(m_text.find('\n', found), m_text.size() - 1) + 1;
        return out;
    }

  private:
    std::string_view m_text;
    std::size_t m_at = 0;
    int m_number = 0;
};

void add(Field field, int line, HeaderFields& out) {
    for (Field& known : out.fields)
        if (known.key == field.key) {
            if (known.value != field.value)
                out.warnings.push_back("line " + std::to_string(line) + ": \"" + field.label +
                                       "\" comes a second time and counts");
            known = std::move(field);
            return;
        }
    out.fields.push_back(std::move(field));
}

}  // namespace

const Field* HeaderFields::find(std::string_view key) const {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [key](const Field& f) { return f.key == key; });
    return found == fields.end() ? nullptr : &*found;
}

std::string normal_key(std::string_view label) {
    std::string out;
    for (char c : to_lower(trim(label))) {
        if (c == '_' || c == '\t')
            c = ' ';
        if (c != ' ' || (!out.empty() && out.back() != ' '))
            out += c;
    }
    return out;
}

bool starts_like_envi(std::string_view text) {
    if (text.starts_with(kByteOrderMark))
        text.remove_prefix(kByteOrderMark.size());
    const auto end = text.find('\n');
    return end != std::string_view::npos && trim(text.substr(0, end)) == "ENVI";
}

Result<HeaderFields> parse_fields(std::string_view text) {
    if (!starts_like_envi(text))
        return fail(ErrorCode::NotSpectral, "is no ENVI header (its first line is not ENVI)");
    HeaderFields out;
    Lines lines(text);
    lines.next();
    while (!lines.at_end()) {
        const std::string_view line = trim(lines.next());
        const int number = lines.number();
        if (line.empty() || line.front() == ';')
            continue;
        const auto equals = line.find('=');
        const std::string label(trim(line.substr(0, std::min(equals, line.size()))));
        if (equals == std::string_view::npos || label.empty()) {
            out.warnings.push_back("line " + std::to_string(number) + ": found \"" +
                                   std::string(line.substr(0, kShownBytes)) +
                                   "\", expected key = value: left out");
            continue;
        }
        const std::string_view value = trim(line.substr(equals + 1));
        Field field{normal_key(label), label, std::string(value), false};
        if (value.starts_with('{') || value.starts_with('[')) {
            const char close = value.front() == '{' ? '}' : ']';
            const auto inside = lines.take_until(value.substr(1), close);
            if (!inside)
                return fail(ErrorCode::Damaged,
                            "the list of \"" + label + "\" is never closed; expected \"" + close + "\"",
                            "line " + std::to_string(number));
            field.value = *inside;
            field.list = true;
        }
        add(std::move(field), number, out);
    }
    return out;
}

std::vector<std::string_view> list_items(std::string_view value) {
    std::vector<std::string_view> out = split(value, ',');
    for (std::string_view& item : out)
        item = trim(item);
    while (!out.empty() && out.back().empty())
        out.pop_back();
    const auto first =
        std::find_if(out.begin(), out.end(), [](std::string_view item) { return !item.empty(); });
    out.erase(out.begin(), first);
    return out;
}

}  // namespace osio::envi
