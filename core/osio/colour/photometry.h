// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/basis.h>

namespace osio {

/// V(lambda), the y-bar of the CIE 1931 observer, at 1 nm.
[[nodiscard]] const NmSamples& photopic_efficiency();

/// V'(lambda) of CIE 1951 at 1 nm; zero outside its table, 380-780 nm.
[[nodiscard]] const NmSamples& scotopic_efficiency();

/// The sums over 360-830 nm that photometry of one spectrum needs. For power in W/nm: watts and lumens;
/// for radiance in W/(sr m2 nm): W/(sr m2) and cd/m2.
struct LightPhotometry {
    double radiant = 0;
    double luminous = 0;
    double scotopic = 0;

    /// Luminous efficacy of radiation, lm/W; zero for darkness.
    [[nodiscard]] double efficacy() const { return radiant == 0 ? 0 : luminous / radiant; }

    [[nodiscard]] double scotopic_efficacy() const { return radiant == 0 ? 0 : scotopic / radiant; }

    /// Scotopic to photopic; zero where there is nothing photopic.
    [[nodiscard]] double sp_ratio() const { return luminous == 0 ? 0 : scotopic / luminous; }
};

/// Sums at 1 nm (CIE 15:2018, 7.1; ISO/CIE 23539:2023).
[[nodiscard]] LightPhotometry photometry_of(const NmSamples& power);

}  // namespace osio
