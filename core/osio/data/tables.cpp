// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/data/tables.h>

#include <algorithm>

namespace osio {

std::optional<Spectrum> Table::column(std::string_view name) const {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [name](std::string_view c) { return iequals(c, name); });
    if (found == columns.end())
        return std::nullopt;
    Spectrum out;
    out.wavelengths_nm.assign(wavelengths_nm.begin(), wavelengths_nm.end());
    out.values.reserve(wavelengths_nm.size());
    for (auto at = static_cast<std::size_t>(found - columns.begin()); at < cells.size(); at += columns.size())
        out.values.push_back(cells[at]);
    return out;
}

const Table* find_table(std::string_view file) {
    const auto tables = embedded_tables();
    const auto found =
        std::find_if(tables.begin(), tables.end(), [file](const Table& table) { return table.file == file; });
    return found == tables.end() ? nullptr : &*found;
}

}  // namespace osio
