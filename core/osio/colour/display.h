// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>
#include <osio/colour/observer.h>
#include <osio/spectra/basis.h>
#include <osio/spectra/spectrum.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// A display by what its three primaries emit. Its light is additive: no crosstalk, no black level.
struct Display {
    std::string path;
    std::string digest;                    ///< names the numbers that were used
    std::array<Spectrum, 3> emission;      ///< red, green, blue at full drive, as tabulated
    std::array<NmSamples, 3> emission_nm;  ///< the same at 1 nm, 360-830 nm, zero outside the table

    /// The spectrum that a linear RGB shows, on the table's own wavelengths and in its unit.
    [[nodiscard]] Spectrum spectrum_of(const Vector3& rgb) const;

    /// XYZ of a linear RGB, with Y = 1 for the display's white (1, 1, 1).
    [[nodiscard]] Matrix3 xyz_from_rgb(const Observer& observer) const;
};

/// A display from a user's table `nm,R,G,B` (see parse_curves_csv). Usage where a primary emits nothing
/// in 360-830 nm. Values slightly below zero, which measured tables hold, are kept.
[[nodiscard]] Result<Display> display_from_csv(std::string_view csv, std::string_view path);

}  // namespace osio
