// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace osio::tool {

/// Columns of text, aligned; numbers to the right, words to the left.
class TextTable {
  public:
    enum class Align { Left, Right };

    struct Column {
        std::string title;
        Align align = Align::Left;
    };

    explicit TextTable(std::vector<Column> columns) : m_columns(std::move(columns)) {}

    void add(std::vector<std::string> row) { m_rows.push_back(std::move(row)); }

    [[nodiscard]] bool empty() const { return m_rows.empty(); }

    /// The table with `indent` spaces in front of every line, a line break after the last.
    [[nodiscard]] std::string text(std::size_t indent = 0) const;

  private:
    std::vector<Column> m_columns;
    std::vector<std::vector<std::string>> m_rows;
};

}  // namespace osio::tool
