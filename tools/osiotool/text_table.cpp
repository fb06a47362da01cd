// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/text_table.h>

#include <fmt/format.h>

#include <algorithm>

namespace osio::tool {

std::string TextTable::text(std::size_t indent) const {
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < m_columns.size(); ++c) {
        widths.push_back(m_columns[c].title.size());
        for (const auto& row : m_rows)
            widths[c] = std::max(widths[c], row[c].size());
    }
    const auto line = [&](auto cell_of) {
        std::string out(indent, ' ');
        for (std::size_t c = 0; c < m_columns.size(); ++c) {
            const bool right = m_columns[c].align == Align::Right;
            out += right ? fmt::format("{:>{}}", cell_of(c), widths[c])
                         : fmt::format("{:<{}}", cell_of(c), widths[c]);
            out += "  ";
        }
        out.erase(out.find_last_not_of(' ') + 1);
        return out + "\n";
    };
    std::string out = line([&](std::size_t c) { return m_columns[c].title; });
    for (const auto& row : m_rows)
        out += line([&](std::size_t c) { return row[c]; });
    return out;
}

}  // namespace osio::tool
