// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/colour/reflectance_set.h>
#include <osio/colour/table_samples.h>
#include <osio/data/tables.h>

namespace osio {

namespace {

constexpr std::string_view kColorChecker = "colorchecker";
constexpr std::string_view kColorCheckerTable = "reflectances/colorchecker_n_ohta.csv";

void add_digest(ReflectanceSet& set) {
    Fingerprint digest;
    for (const NmSamples& spectrum : set.spectra)
        digest.add(digest_of(spectrum));
    set.digest = digest.hex();
}

/// Columns of values in the table's last line, which is no header.
std::size_t value_columns(std::string_view csv) {
    std::string_view last;
    for (const std::string_view line : split(csv, '\n'))
        if (!trim(line).empty() && !trim(line).starts_with('#'))
            last = trim(line);
    std::size_t pieces = 0;
    bool inside = false;
    for (const char c : last) {
        const bool separator = c == ',' || c == ';' || c == '\t' || c == ' ';
        pieces += !separator && !inside ? 1 : 0;
        inside = !separator;
    }
    return pieces > 0 ? pieces - 1 : 0;
}

}  // namespace

Result<ReflectanceSet> find_reflectance_set(std::string_view name) {
    if (!iequals(name, kColorChecker))
        return fail(ErrorCode::UnknownName,
                    "no set of reflectances is called \"" + std::string(name) +
                        "\"; expected colorchecker, or the path of a .csv: nm and one column a spectrum");
    const Table& table = *find_table(kColorCheckerTable);
    ReflectanceSet set{std::string(kColorChecker), std::string(table.sources[0]), {}, {}};
    for (const std::string_view column : table.columns)
        set.spectra.push_back(sampled_at_1nm_held(*table.column(column)));
    add_digest(set);
    return set;
}

Result<ReflectanceSet> reflectance_set_from_csv(std::string_view csv, std::string_view path) {
    const std::size_t count = value_columns(csv);
    if (count == 0)
        return fail(ErrorCode::Usage, "holds no spectrum; expected nm and one column for each",
                    std::string(path));
    auto curves = parse_curves_csv(csv, count);
    if (!curves)
        return fail_within(path, std::move(curves).error());
    ReflectanceSet set{std::string(path), "the user's table", {}, {}};
    for (const Spectrum& curve : *curves)
        set.spectra.push_back(sampled_at_1nm_held(curve));
    add_digest(set);
    return set;
}

}  // namespace osio
