// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/layout/dialect.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace osio {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Advances `text` over at least one digit.
bool take_digits(std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
    const auto length = static_cast<std::size_t>(end - text.begin());
    text.remove_prefix(length);
    return length > 0;
}

bool take(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix))
        return false;
    text.remove_prefix(prefix.size());
    return true;
}

/// 395.00-405.00nm, behind an optional layer: half-open bins of Mitsuba 0.4 to 0.6.
bool is_mitsuba_bin(std::string_view name) {
    const auto fits = [](std::string_view text) {
        return take_digits(text) && take(text, ".") && take_digits(text) && take(text, "-") &&
               take_digits(text) && take(text, ".") && take_digits(text) && text == "nm";
    };
    for (;;) {
        if (fits(name))
            return true;
        const auto dot = name.find('.');
        if (dot == std::string_view::npos)
            return false;
        name.remove_prefix(dot + 1);
    }
}

/// wavelength430_25, behind an optional "spectral.": lower edges of Indigo's buckets.
bool is_indigo_bucket(std::string_view name) {
    take(name, "spectral.");
    if (!take(name, "wavelength") || !take_digits(name))
        return false;
    return name.empty() || (take(name, "_") && take_digits(name) && name.empty());
}

/// Radiance.C07 of ISET3D.
bool is_iset_band(std::string_view name) {
    return take(name, "Radiance.C") && take_digits(name) && name.empty();
}

/// Band12 of GDAL.
bool is_gdal_band(std::string_view name) {
    return take(name, "Band") && take_digits(name) && name.empty();
}

bool is_integer(std::string_view name) {
    return take_digits(name) && name.empty();
}

/// A number directly in front of a unit of wavelength, anywhere in the name.
bool holds_wavelength(std::string_view name) {
    constexpr std::array<std::string_view, 5> kUnits{"nm", "um", "\xC2\xB5m", "\xCE\xBCm", "THz"};
    for (const std::string_view unit : kUnits)
        for (auto at = name.find(unit); at != std::string_view::npos; at = name.find(unit, at + 1))
            if (at > 0 && is_digit(name[at - 1]))
                return true;
    return false;
}

template <class Fits>
const std::string* at_least_two(std::span<const std::string> names, Fits fits) {
    if (std::count_if(names.begin(), names.end(), fits) < 2)
        return nullptr;
    return &*std::find_if(names.begin(), names.end(), fits);
}

}  // namespace

std::optional<std::string> recognise_dialect(std::span<const std::string> channel_names,
                                             std::span<const std::string> attribute_names) {
    const auto has_attribute = [&](std::string_view name) {
        return std::find(attribute_names.begin(), attribute_names.end(), name) != attribute_names.end();
    };
    const auto such_as = [](std::string_view what, const std::string& name) {
        return std::string(what) + " such as \"" + name + "\"";
    };
    if (const auto* name = at_least_two(channel_names, [&](const std::string& channel) {
            return has_attribute(channel + ".wavelength");
        }))
        return such_as("Ocean channels with .wavelength attributes", *name);
    if (const auto* name = at_least_two(channel_names, is_mitsuba_bin))
        return such_as("Mitsuba 0.x wavelength bins", *name);
    if (const auto* name = at_least_two(channel_names, is_indigo_bucket))
        return such_as("Indigo wavelength buckets", *name);
    if (const auto* name = at_least_two(channel_names, is_iset_band))
        return such_as("ISET3D radiance bands", *name);
    const bool gdal = std::any_of(attribute_names.begin(), attribute_names.end(),
                                  [](const std::string& a) { return a.starts_with("gdal:"); });
    if (const auto* name = gdal ? at_least_two(channel_names, is_gdal_band) : nullptr)
        return such_as("GDAL bands", *name);
    if (std::all_of(channel_names.begin(), channel_names.end(), is_integer))
        if (const auto* name = at_least_two(channel_names, is_integer))
            return such_as("OpenCV's numbered channels, which hold no wavelengths,", *name);
    if (const auto* name = at_least_two(channel_names, holds_wavelength))
        return such_as("names with a wavelength in them", *name);
    return std::nullopt;
}

}  // namespace osio
