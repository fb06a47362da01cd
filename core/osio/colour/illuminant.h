// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>
#include <osio/colour/observer.h>
#include <osio/colour/table_samples.h>
#include <osio/spectra/basis.h>
#include <osio/spectra/spectrum.h>

#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// A light: relative spectral power at 1 nm, 360-830 nm, and below it as far as its table goes. Its scale
/// never matters.
struct Illuminant {
    std::string id;      ///< "D65", or the path of the user's table
    std::string source;  ///< standard and edition, or the user's table
    std::string digest;  ///< of the table: names the numbers that were used
    NmSamples power{};
    UltravioletSamples ultraviolet{};    ///< power there, which only fluorescence turns into colour
    double first_nm = kObserverFirstNm;  ///< where its table begins; zero counts beyond it
    double last_nm = kObserverLastNm;    ///< where its table ends
};

/// The light of that name (case ignored): a table ("D65", "A", "FL11", "HPS", ...; F2 is read as FL2),
/// or a formula: "D(6200)", CIE daylight (see daylight_power), and "blackbody(3200)" (see
/// blackbody_power), in kelvin. UnknownName names the nearest; Usage where a formula is not defined.
[[nodiscard]] Result<Illuminant> find_illuminant(std::string_view name);

/// A light from a user's table (see parse_spectrum_csv): straight lines at 1 nm, zero outside it.
/// Negative power and a table without power inside 360-830 nm are refused.
[[nodiscard]] Result<Illuminant> illuminant_from_csv(std::string_view csv, std::string_view path);

/// Every table that find_illuminant knows by name.
[[nodiscard]] std::vector<std::string> illuminant_names();

/// Tristimulus values of the perfect diffuser under `light`, Y = 1, over 360-830 nm. InvalidGrid
/// where the light has no luminance to normalise by.
[[nodiscard]] Result<Vector3> white_point(const Illuminant& light, const Observer& observer,
                                          Quadrature quadrature = Quadrature::Sum1nm);

}  // namespace osio
