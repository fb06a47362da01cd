// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/colour/observer.h>
#include <osio/colour/table_samples.h>
#include <osio/data/tables.h>

#include <optional>

namespace osio {

namespace {

constexpr std::string_view kFolder = "observers/";
constexpr std::string_view kPhotopic = "photopic";
constexpr std::string_view kPhotopicTable = "observers/cie1931.csv";
constexpr std::array<std::string_view, 3> kChannels{"R", "G", "B"};

std::string id_of(const Table& table) {
    const std::string_view name = table.file.substr(kFolder.size());
    return std::string(name.substr(0, name.rfind('.')));
}

std::string digest_of(const std::array<NmSamples, 3>& curves) {
    Fingerprint fingerprint;
    for (const NmSamples& curve : curves)
        fingerprint.add(osio::digest_of(curve));
    return fingerprint.hex();
}

Observer luminous(std::string_view id, const Table& table, std::size_t column, std::string source) {
    Observer out{std::string(id), std::move(source), {}, ObserverKind::Luminous, {}};
    out.curves[1] = sampled_at_1nm(*table.column(table.columns[column]));
    out.digest = digest_of(out.curves);
    return out;
}

Observer from_table(const Table& table) {
    if (table.columns.size() == 1)
        return luminous(id_of(table), table, 0, std::string(table.sources[0]));
    Observer out{id_of(table), std::string(table.sources[0]), {}, ObserverKind::Colorimetric, {}};
    for (std::size_t c = 0; c < out.curves.size(); ++c)
        out.curves[c] = sampled_at_1nm(*table.column(table.columns[c]));
    out.digest = digest_of(out.curves);
    return out;
}

}  // namespace

Result<Observer> find_observer(std::string_view name) {
    if (iequals(name, kPhotopic)) {
        const Table& table = *find_table(kPhotopicTable);
        return luminous(kPhotopic, table, 1,
                        "V(lambda), CIE 1924; the y-bar of " + std::string(table.sources[1]));
    }
    for (const Table& table : embedded_tables())
        if (table.file.starts_with(kFolder) && iequals(id_of(table), name))
            return from_table(table);
    return fail(ErrorCode::UnknownName,
                "no observer is called \"" + std::string(name) + "\"" + suggestion(name, observer_names()) +
                    " (a camera's table of nm,R,G,B is named by its path and ends in .csv)");
}

Result<Observer> camera_from_csv(std::string_view csv, std::string_view path) {
    const auto curves = parse_curves_csv(csv, kChannels.size());
    if (!curves)
        return fail_within(path, curves.error());
    Observer out{std::string(path), "camera table " + std::string(path), {}, ObserverKind::Camera, {}};
    for (std::size_t c = 0; c < kChannels.size(); ++c) {
        out.curves[c] = sampled_at_1nm((*curves)[c]);
        OSIO_CHECK_OK(
            check_not_black(out.curves[c], (*curves)[c], std::string(kChannels[c]) + " sensitivity", path));
    }
    out.digest = digest_of(out.curves);
    return out;
}

std::vector<std::string> observer_names() {
    std::vector<std::string> names;
    for (const Table& table : embedded_tables())
        if (table.file.starts_with(kFolder))
            names.push_back(id_of(table));
    names.emplace_back(kPhotopic);
    return names;
}

}  // namespace osio
