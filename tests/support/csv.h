// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/text.h>

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace osio::test {

/// The rows of a CSV file with a header line, each a map from column name to text. Fields may be
/// quoted; quotes inside a quoted field are not supported.
class Csv {
  public:
    using Row = std::map<std::string, std::string, std::less<>>;

    explicit Csv(const std::string& path) {
        std::ifstream in(path);
        if (!in)
            throw std::runtime_error("cannot open " + path);
        std::string line;
        std::getline(in, line);
        header = fields(line);
        while (std::getline(in, line)) {
            const auto cells = fields(line);
            Row row;
            for (std::size_t i = 0; i < header.size() && i < cells.size(); ++i)
                row[header[i]] = cells[i];
            rows.push_back(std::move(row));
        }
    }

    std::vector<std::string> header;
    std::vector<Row> rows;

  private:
    static std::vector<std::string> fields(std::string_view line) {
        std::vector<std::string> out(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                out.emplace_back();
            else if (c != '\r')
                out.back() += c;
        }
        return out;
    }
};

inline double number(const Csv::Row& row, std::string_view column) {
    return parse_double(row.find(column)->second).value();
}

inline std::string golden(const std::string& file) {
    return std::string(OSIO_TEST_DIR) + "/golden/" + file;
}

}  // namespace osio::test
