// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/tiff/gdal_metadata.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

/// How items of GDAL's metadata are called and spelt.
namespace osio::tiff {

inline constexpr std::array<std::string_view, 5> kWavelengthNames{
    "wavelength", "wavelengths", "center_wavelength", "centre_wavelength", "central_wavelength"};
inline constexpr std::array<std::string_view, 3> kUnitNames{"wavelength_units", "wavelength_unit",
                                                            "wavelengths_units"};
inline constexpr std::array<std::string_view, 5> kQuantityNames{"data_units", "data_unit", "units",
                                                                "z_plot_titles", "description"};

/// An item's name as it is compared: in lower case; ENVI's keys come with spaces or underscores.
[[nodiscard]] std::string normal_name(std::string_view name);

template <std::size_t N>
[[nodiscard]] bool is_one_of(std::string_view name, const std::array<std::string_view, N>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The items of a list: between commas or semicolons, or white space where there are none; braces around are left
/// out.
[[nodiscard]] std::vector<std::string> list_of(std::string_view text);

/// True for an item of an image that read_bands() gives a meaning, which a writer states itself.
[[nodiscard]] bool says_something(const GdalItem& item);

}  // namespace osio::tiff
