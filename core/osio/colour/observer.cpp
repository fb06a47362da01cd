// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/observer.h>
#include <osio/data/tables.h>

#include <algorithm>

namespace osio {

namespace {

constexpr std::string_view kFolder = "observers/";

std::string id_of(const Table& table) {
    const std::string_view name = table.file.substr(kFolder.size());
    return std::string(name.substr(0, name.rfind('.')));
}

}  // namespace

Result<Observer> find_observer(std::string_view name) {
    for (const Table& table : embedded_tables()) {
        if (!table.file.starts_with(kFolder) || !iequals(id_of(table), name))
            continue;
        Observer out{id_of(table), std::string(table.sources[0]), std::string(table.sha256), {}};
        for (std::size_t i = 0; i < table.wavelengths_nm.size(); ++i) {
            const auto at = static_cast<std::size_t>(table.wavelengths_nm[i] - kObserverFirstNm);
            for (std::size_t c = 0; c < out.curves.size(); ++c)
                out.curves[c][at] = table.cells[i * table.columns.size() + c];
        }
        return out;
    }
    return fail(ErrorCode::UnknownName,
                "no observer is called \"" + std::string(name) + "\"" + suggestion(name, observer_names()));
}

std::vector<std::string> observer_names() {
    std::vector<std::string> names;
    for (const Table& table : embedded_tables())
        if (table.file.starts_with(kFolder))
            names.push_back(id_of(table));
    return names;
}

}  // namespace osio
