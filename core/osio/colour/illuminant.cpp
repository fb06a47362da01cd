// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/daylight.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/planckian.h>
#include <osio/colour/table_samples.h>
#include <osio/data/tables.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace osio {

namespace {

constexpr std::string_view kTable = "illuminants/cie_1nm.csv";
constexpr std::string_view kUltravioletTable = "illuminants/cie_uv.csv";

/// Below this share of luminous power in a light (an ultraviolet lamp, say) 1/Y is noise: the
/// smallest value of a CIE y-bar between 360 and 830 nm is 4.5e-7.
constexpr double kSmallestLuminousShare = 1e-9;

/// CIE 15 calls the fluorescent lamps FL1...; F1... is the older name.
std::string canonical(std::string_view name) {
    const std::string lower = to_lower(name);
    const bool old_name = lower.size() > 1 && lower[0] == 'f' && lower[1] >= '0' && lower[1] <= '9';
    return old_name ? "fl" + lower.substr(1) : lower;
}

/// Tables with one light each: the file's name is the light's.
constexpr std::array<std::string_view, 2> kFolders{"illuminants/", "light_sources/"};
constexpr std::string_view kPowerColumn = "S";

Illuminant light_of(std::string_view id, std::string_view source, const NmSamples& power,
                    const UltravioletSamples& ultraviolet, double first_nm, double last_nm) {
    return {std::string(id), std::string(source), digest_of(power), power, ultraviolet, first_nm, last_nm};
}

Illuminant light_of(std::string_view id, std::string_view source, const Spectrum& curve) {
    return light_of(id, source, sampled_at_1nm(curve), ultraviolet_at_1nm(curve),
                    curve.wavelengths_nm.front(), curve.wavelengths_nm.back());
}

/// A column of the table at 1 nm, which has zeros where the light's own table says nothing, and its
/// ultraviolet where there is any.
Illuminant light_of_column(const Table& table, std::size_t index) {
    const Spectrum curve = *table.column(table.columns[index]);
    const auto stated = [](double power) { return power != 0; };
    const auto first = std::find_if(curve.values.begin(), curve.values.end(), stated);
    const auto last = std::find_if(curve.values.rbegin(), curve.values.rend(), stated);
    double first_nm = curve.wavelengths_nm[static_cast<std::size_t>(first - curve.values.begin())];
    const double last_nm =
        curve
            .wavelengths_nm[curve.values.size() - 1 - static_cast<std::size_t>(last - curve.values.rbegin())];
    UltravioletSamples ultraviolet{};
    if (const auto below = find_table(kUltravioletTable)->column(table.columns[index])) {
        ultraviolet = ultraviolet_at_1nm(*below);
        first_nm = below->wavelengths_nm.front();
    }
    return light_of(table.columns[index], table.sources[index], sampled_at_1nm(curve), ultraviolet, first_nm,
                    last_nm);
}

/// Calls visit(light's name, table) for each table of one light.
template <class Visit>
void visit_single_tables(Visit visit) {
    for (const std::string_view folder : kFolders)
        for (const Table& table : embedded_tables())
            if (table.file.starts_with(folder) && table.columns.size() == 1 &&
                table.columns[0] == kPowerColumn) {
                const std::string_view file = table.file.substr(folder.size());
                visit(file.substr(0, file.rfind('.')), table);
            }
}

/// The argument of `function(kelvin)`; nothing where the name is another.
std::optional<std::string_view> argument_of(std::string_view function, std::string_view name) {
    if (name.size() < function.size() + 2 || !iequals(name.substr(0, function.size()), function) ||
        name[function.size()] != '(' || name.back() != ')')
        return std::nullopt;
    return trim(name.substr(function.size() + 1, name.size() - function.size() - 2));
}

Result<double> parse_kelvin(std::string_view text, std::string_view name) {
    const auto kelvin = iequals(text, "inf") ? std::numeric_limits<double>::infinity() : parse_double(text);
    if (!kelvin || *kelvin <= 0)
        return fail(ErrorCode::Usage, "\"" + std::string(name) + "\": found \"" + std::string(text) +
                                          "\", expected a temperature in kelvin above 0, such as 3200");
    return *kelvin;
}

Result<std::optional<Illuminant>> light_by_formula(std::string_view name) {
    if (const auto text = argument_of("D", name)) {
        OSIO_TRY(const double kelvin, parse_kelvin(*text, name));
        OSIO_TRY(const NmSamples power, daylight_power(kelvin));
        OSIO_TRY(const UltravioletSamples ultraviolet, daylight_ultraviolet(kelvin));
        return light_of(
            "D(" + format_double(kelvin) + ")",
            "CIE daylight, S0 + M1 S1 + M2 S2 with M1, M2 rounded to 3 decimals (CIE 15:2018, 4.1.2)", power,
            ultraviolet, kDaylightFirstNm, kObserverLastNm);
    }
    if (const auto text = argument_of("blackbody", name)) {
        OSIO_TRY(const double kelvin, parse_kelvin(*text, name));
        const bool limit = std::isinf(kelvin);
        return light_of("blackbody(" + (limit ? "inf" : format_double(kelvin)) + ")",
                        limit ? "limit of Rayleigh and Jeans, lambda^-4"
                              : "Planck's law, c2 = 1.438776877e7 nm K (CODATA 2018)",
                        blackbody_power(kelvin), blackbody_ultraviolet(kelvin), kUltravioletFirstNm,
                        kObserverLastNm);
    }
    return std::nullopt;
}

}  // namespace

Result<Illuminant> find_illuminant(std::string_view name) {
    OSIO_TRY(std::optional<Illuminant> light, light_by_formula(name));
    if (light)
        return std::move(*light);
    const Table& table = *find_table(kTable);
    const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                     [&](std::string_view c) { return to_lower(c) == canonical(name); });
    if (column != table.columns.end())
        return light_of_column(table, static_cast<std::size_t>(column - table.columns.begin()));
    visit_single_tables([&](std::string_view id, const Table& single) {
        if (iequals(id, name))
            light = light_of(id, single.sources[0], *single.column(kPowerColumn));
    });
    if (light)
        return std::move(*light);
    return fail(ErrorCode::UnknownName, "no illuminant is called \"" + std::string(name) + "\"" +
                                            suggestion(name, illuminant_names()) +
                                            " (a table of your own is named by its path and ends in .csv)");
}

Result<Illuminant> illuminant_from_csv(std::string_view csv, std::string_view path) {
    auto spectrum = parse_spectrum_csv(csv);
    if (!spectrum)
        return fail_within(path, spectrum.error());
    for (std::size_t i = 0; i < spectrum->values.size(); ++i)
        if (spectrum->values[i] < 0)
            return fail(ErrorCode::Usage,
                        "the power " + format_double(spectrum->values[i]) + " at " +
                            format_double(spectrum->wavelengths_nm[i]) +
                            " nm is negative; a light has none below zero",
                        std::string(path));
    OSIO_CHECK_OK(check_not_black(sampled_at_1nm(*spectrum), *spectrum, "power", path));
    return light_of(path, "table " + std::string(path), *spectrum);
}

std::vector<std::string> illuminant_names() {
    const Table& table = *find_table(kTable);
    std::vector<std::string> names(table.columns.begin(), table.columns.end());
    visit_single_tables([&](std::string_view id, const Table&) { names.emplace_back(id); });
    return names;
}

Result<Vector3> white_point(const Illuminant& light, const Observer& observer, Quadrature quadrature) {
    Vector3 xyz{};
    for (std::size_t c = 0; c < 3; ++c)
        xyz[c] = integral(light.power, observer.curves[c], quadrature);
    const double power = std::accumulate(light.power.begin(), light.power.end(), 0.0);
    if (!(xyz[1] > kSmallestLuminousShare * power))
        return fail(ErrorCode::InvalidGrid,
                    "the light has no luminance (sum of S y-bar is " + format_double(xyz[1]) +
                        "), so no white can be normalised to Y = 1",
                    light.id);
    return Vector3{xyz[0] / xyz[1], 1.0, xyz[2] / xyz[1]};
}

}  // namespace osio
