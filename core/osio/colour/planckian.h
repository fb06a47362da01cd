// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/colour/table_samples.h>
#include <osio/spectra/basis.h>

/// Thermal light by formula.
namespace osio {

/// Second radiation constant h c / k, nm K: CODATA 2018 (exact by definition of the SI of 2019).
inline constexpr double kSecondRadiationNmK = 1.438776877503933802e7;

/// Spectral radiance of a blackbody, W/(m2 sr nm), at `wavelength_nm` > 0 and `temperature_kelvin`.
///
/// Planck's law L = 2 h c^2 / lambda^5 / (exp(x) - 1), x = h c / (lambda k T), with the constants of
/// CODATA 2018. Relative error at most 1e-15 + 2.5e-16 x wherever L is a normal double, also where
/// exp(x) is none. 0 for T <= 0; infinite for infinite T.
[[nodiscard]] double planck_radiance_w_m2_sr_nm(double wavelength_nm, double temperature_kelvin);

/// Relative power of a blackbody at 1 nm, largest value 100: finite for every T > 0, however cold.
/// Infinite T gives the limit of Rayleigh and Jeans, lambda^-4.
[[nodiscard]] NmSamples blackbody_power(double temperature_kelvin);

/// Its ultraviolet on the same scale: 100 is the largest value of 360-830 nm.
[[nodiscard]] UltravioletSamples blackbody_ultraviolet(double temperature_kelvin);

}  // namespace osio
