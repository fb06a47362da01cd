// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace osio {

/// A unit in which files of cameras write wavelengths: "nm", "um", "mm", "cm", "m", "MHz", "GHz", "THz", "cm-1".
using WavelengthUnit = std::string_view;

/// The unit of a word of such files, in any case and spelling: "Nanometers", "micron", "Wavenumber"; nothing for
/// other words.
[[nodiscard]] std::optional<WavelengthUnit> find_wavelength_unit(std::string_view word);

/// What numbers without a unit are taken for: "um" where all are below 100, else "nm". Nothing that makes images
/// sees 100 nm.
[[nodiscard]] WavelengthUnit likely_unit(std::span<const double> numbers);

/// A decimal with a point, as it stands in a file, in nm; 0 where it is none above 0. The decimal is scaled before it
/// is rounded, so 0.55 um and 550 nm are the same double.
[[nodiscard]] double nm_of(std::string_view number, WavelengthUnit unit);

/// A width in nm around `centre_nm`, which `centre` is in the same unit. Of frequencies and wavenumbers v, to first
/// order: dl/l = dv/v. 0 where either is none.
[[nodiscard]] double width_nm(double width, double centre, double centre_nm, WavelengthUnit unit);

/// The wavelengths that words name, in nm: "band 1 (418.24 Nanometers)", "col_0500_nm", "ms_450nm". A number
/// counts with a unit of nm, um or THz behind it, at most one of " _-" between.
[[nodiscard]] std::vector<double> wavelengths_in(std::string_view text);

}  // namespace osio
