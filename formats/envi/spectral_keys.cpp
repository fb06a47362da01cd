// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/spectral_keys.h>

#include <osio/base/text.h>
#include <osio/layout/part_layout.h>
#include <osio/spectra/wavelength_unit.h>

#include <algorithm>
#include <array>

namespace osio::envi {

namespace {

/// Spellings of keys that are met in real files, for the ones that are meant.
constexpr std::array<std::array<std::string_view, 2>, 5> kMisspelt{{
    {"wavelengths", "wavelength"},
    {"wavelengths units", "wavelength units"},
    {"wavelength unit", "wavelength units"},
    {"wavelength unts", "wavelength units"},
    {"bad bands list", "bbl"},
}};

/// The field of a key or of a misspelling of it, which is said aloud.
const Field* find_spelt(EnviHeader& header, std::string_view key) {
    if (const Field* found = header.fields.find(key))
        return found;
    for (const auto& [found, meant] : kMisspelt)
        if (meant == key)
            if (const Field* field = header.fields.find(found)) {
                header.warnings.push_back("\"" + field->label + "\" is taken as \"" + std::string(key) +
                                          "\"");
                return field;
            }
    return nullptr;
}

Result<std::vector<std::string_view>> items_by_band(const EnviHeader& header, const Field& field) {
    auto items = list_items(field.value);
    if (items.size() != header.bands)
        return fail(ErrorCode::Damaged, "found " + std::to_string(items.size()) + " items of \"" +
                                            field.label + "\" for " + std::to_string(header.bands) +
                                            " bands");
    return items;
}

tl::unexpected<Error> no_number(const Field& field, std::string_view item) {
    return fail(ErrorCode::Damaged, "found \"" + std::string(item.substr(0, 40)) + "\" in \"" + field.label +
                                        "\", expected a number");
}

Result<std::vector<double>> numbers_of(const EnviHeader& header, const Field& field) {
    OSIO_TRY(const auto items, items_by_band(header, field));
    std::vector<double> out;
    for (const std::string_view item : items) {
        const auto value = parse_double(item);
        if (!value)
            return no_number(field, item);
        out.push_back(*value);
    }
    return out;
}

/// The unit, guessed where the header has none; empty where the numbers are no wavelengths.
WavelengthUnit unit_of(EnviHeader& header, const std::vector<double>& numbers) {
    const Field* const field = find_spelt(header, "wavelength units");
    const std::string word = field == nullptr ? std::string() : to_lower(trim(field->value));
    if (const auto unit = find_wavelength_unit(word))
        return *unit;
    if (word == "index") {
        header.warnings.emplace_back("\"wavelength units\" are Index: the bands have no wavelengths");
        return {};
    }
    const WavelengthUnit unit = likely_unit(numbers);
    header.warnings.push_back((word.empty() ? std::string("no \"wavelength units\"")
                                            : "\"wavelength units\" are \"" + field->value + "\"") +
                              ": the wavelengths are taken as " +
                              (unit == "um" ? "micrometres" : "nanometres"));
    return unit;
}

Result<void> read_wavelengths(EnviHeader& header) {
    const Field* const field = find_spelt(header, "wavelength");
    if (field == nullptr) {
        header.warnings.emplace_back("no \"wavelength\": the bands have no wavelengths");
        return {};
    }
    OSIO_TRY(const auto items, items_by_band(header, *field));
    OSIO_TRY(const auto numbers, numbers_of(header, *field));
    const WavelengthUnit unit = unit_of(header, numbers);
    if (unit.empty())
        return {};
    std::size_t without = 0;
    for (std::size_t band = 0; band < items.size(); ++band) {
        header.wavelengths_nm.push_back(nm_of(items[band], unit));
        without += header.wavelengths_nm.back() == 0;
    }
    if (without > 0)
        header.warnings.push_back(std::to_string(without) + " of " + std::to_string(header.bands) +
                                  " bands have no wavelength above 0 and are left out of the set");

    OSIO_TRY(const auto widths, numbers_by_band(header, "fwhm"));
    for (std::size_t band = 0; band < widths.size(); ++band)
        header.fwhm_nm.push_back(width_nm(widths[band], numbers[band], header.wavelengths_nm[band], unit));
    return {};
}

/// The map's wavelengths in the place of the header's.
Result<void> map_wavelengths(EnviHeader& header, const BandMap& map) {
    std::vector<std::string> names;
    for (std::uint64_t band = 1; band <= header.bands; ++band)
        names.push_back("band." + std::to_string(band));
    OSIO_TRY(const auto places, map_bands(map, names));
    for (const auto& place : places) {
        header.wavelengths_nm.push_back(place ? place->wavelength_nm : 0);
        header.fwhm_nm.push_back(place ? place->fwhm_nm.value_or(0) : 0);
    }
    return {};
}

Result<void> read_bad_bands(EnviHeader& header) {
    const Field* const field = find_spelt(header, "bbl");
    if (field == nullptr)
        return {};
    OSIO_TRY(const auto good, numbers_of(header, *field));
    std::size_t count = 0;
    for (const double value : good) {
        header.bad.push_back(value == 0);
        count += value == 0;
    }
    if (count > 0)
        header.warnings.push_back(std::to_string(count) + " of " + std::to_string(header.bands) +
                                  " bands are bad by \"bbl\" and are left out of the set");
    return {};
}

/// Keys that may say what the numbers are, in the order in which they are believed.
constexpr std::array<std::string_view, 6> kUnitKeys{"data units",    "data unit",      "units",
                                                    "z plot titles", "data type name", "description"};

/// The words around "radiance" are its unit; our own files carry it apart, as the layout's attribute.
void read_units(const Field& field, EnviHeader& header) {
    if (!iequals(trim(field.value), "radiance"))
        header.units = trim(field.value);
    else if (header.fields.find("exr string emissiveunits") == nullptr)
        header.warnings.push_back("\"" + field.label + "\" name no unit: radiance is taken as " +
                                  std::string(kWrittenEmissiveUnits) + " per nm");
}

Result<void> read_quantity(EnviHeader& header, std::optional<Quantity> word) {
    if (header.fields.find("reflectance scale factor") != nullptr)
        return check_quantity(word, header.quantity, "the header has a \"reflectance scale factor\"");
    for (const std::string_view key : kUnitKeys) {
        const Field* const field = header.fields.find(key);
        const std::string text = field == nullptr ? std::string() : to_lower(field->value);
        const bool radiance = text.find("radiance") != std::string::npos;
        const bool reflectance = text.find("reflectance") != std::string::npos;
        if (radiance == reflectance)
            continue;
        header.quantity = radiance ? Quantity::Radiance : Quantity::Reflectance;
        if (radiance)
            read_units(*field, header);
        return check_quantity(word, header.quantity,
                              "the header says \"" + field->label + " = " +
                                  std::string(trim(field->value)).substr(0, 60) + "\"");
    }
    header.quantity = quantity_of(assumed_family(word, header.warnings));
    return {};
}

}  // namespace

Result<std::vector<double>> numbers_by_band(const EnviHeader& header, std::string_view key) {
    const Field* const field = header.fields.find(key);
    return field == nullptr ? std::vector<double>() : numbers_of(header, *field);
}

Result<void> read_spectral_keys(EnviHeader& header, const OpenWords& words) {
    OSIO_CHECK_OK(words.wavelengths ? map_wavelengths(header, *words.wavelengths) : read_wavelengths(header));
    OSIO_CHECK_OK(read_bad_bands(header));
    return read_quantity(header, words.quantity);
}

}  // namespace osio::envi
