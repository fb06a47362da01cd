// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Wavelengths are doubles in nanometres, in vacuum, everywhere.
namespace osio {

/// Speed of light in vacuum, m/s; exact by definition of the metre (SI 2019).
inline constexpr double kSpeedOfLightMPerS = 299792458.0;

/// The domain of the CIE standard observers, nm (ISO/CIE 11664-1).
inline constexpr int kObserverFirstNm = 360;
inline constexpr int kObserverLastNm = 830;
inline constexpr std::size_t kObserverSampleCount = kObserverLastNm - kObserverFirstNm + 1;

/// Which characters may stand between the whole and the fractional digits of a number.
enum class DecimalMark {
    Comma,   ///< the spectral EXR layout's channel names: a point separates fields there
    Point,   ///< our comma-free channel names, CSV, attributes of the layout
    Either,  ///< attributes as found in files
};

/// Reads `number [prefix] unit` at the start of `text`, up to its end or a `.`, as a wavelength in nm.
///
/// number = digits [mark digits] [(e|E) [+|-] digits], at least one digit, no sign; prefix = an SI
/// prefix from y to Y, with u, U+00B5 or U+03BC for micro; unit = m or Hz, case-sensitive (Fichet,
/// Pacanowski, Wilkie: An OpenEXR Layout for Spectral Images, JCGT 10(3), 2021). The decimal is
/// scaled before it is rounded, so 0,55um and 550nm are the same double. Frequencies become
/// c / f; only the abscissa is converted, never a density.
///
/// On success `text` is advanced past the unit. Zero and what overflows a double are refused.
[[nodiscard]] std::optional<double> take_wavelength_nm(std::string_view& text, DecimalMark mark);

/// The whole of `text` as a wavelength in nm, as take_wavelength_nm reads it.
[[nodiscard]] std::optional<double> parse_wavelength_nm(std::string_view text, DecimalMark mark);

/// The shortest number that reads back as the same double, with `mark` (Comma or Point), then "nm".
[[nodiscard]] std::string format_wavelength(double wavelength_nm, DecimalMark mark);

}  // namespace osio
