// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// A curve over wavelength: strictly increasing wavelengths in nm and a value at each, joined by
/// straight lines, zero outside.
struct Spectrum {
    std::vector<double> wavelengths_nm;
    std::vector<double> values;

    /// The value at `wavelength_nm`; zero outside the first and last sample.
    [[nodiscard]] double linear_at(double wavelength_nm) const;

    /// The value at `wavelength_nm`; the end values outside. Not for an empty curve.
    [[nodiscard]] double held_at(double wavelength_nm) const;
};

/// A spectrum from a header attribute of the spectral EXR layout, and what had to be passed over.
struct SpectrumText {
    Spectrum spectrum;
    std::vector<std::string> rejected;  ///< the pieces that are no `wavelength:value`
};

/// Reads `<wavelength><unit>:<value>;...` as tolerantly as real files need: with or without the
/// last `;`, with spaces, with a point or a comma, in any order. The layout's reference library
/// requires the last `;` and colour-science refuses it; both are read here. Infinities, NaN and
/// pieces without a unit are rejected and listed; of equal wavelengths the first stays.
[[nodiscard]] SpectrumText parse_spectrum_text(std::string_view text);

/// A curve as `<wavelength>nm:<value>;...` in the one spelling that every known reader takes whole: points, shortest
/// numbers, and the last sample twice, the second time without `;`. The layout's reference library reads what ends
/// in `;` and passes over the rest, colour-science refuses a `;` at the end and keeps one sample of equal
/// wavelengths. Negative values the reference library passes over however they are written. Empty for no samples.
[[nodiscard]] std::string format_spectrum_text(const Spectrum& spectrum);

/// Reads a two-column table `nm,value`: comma, semicolon, tab or spaces between the columns, a
/// decimal point, lines starting with `#` and one header line optional. Wavelengths must be
/// positive, strictly increasing and in nanometres, values finite. The error names the line.
[[nodiscard]] Result<Spectrum> parse_spectrum_csv(std::string_view text);

/// The same with `count` columns of values behind the wavelength: one curve for each.
[[nodiscard]] Result<std::vector<Spectrum>> parse_curves_csv(std::string_view text, std::size_t count);

}  // namespace osio
