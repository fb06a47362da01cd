// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/planckian.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// 2 h c^2 in W nm^4 / (m2 sr): 1.191042972397188414e-16 W m2 of CODATA 2018, for lambda in nm.
constexpr double kFirstRadiation = 1.191042972397188414e20;

/// What kSecondRadiationNmK lost when it was rounded to a double.
constexpr double kSecondRadiationRest =
    1.4387768775039338021466716e7L - static_cast<long double>(kSecondRadiationNmK);

/// h c / (lambda k T) as a rounded value and what rounding left over: exp(-x) magnifies a relative
/// error of x by x itself.
struct Exponent {
    double value;
    double rest;
};

Exponent exponent(double wavelength_nm, double temperature_kelvin) {
    const double product = wavelength_nm * temperature_kelvin;
    const double product_rest = std::fma(wavelength_nm, temperature_kelvin, -product);
    const double x = kSecondRadiationNmK / product;
    const double remainder =
        std::fma(-x, product, kSecondRadiationNmK) - x * product_rest + kSecondRadiationRest;
    return {x, remainder / product};
}

/// ln L + constant: L itself can be below any double.
double log_power(double nm, double temperature_kelvin) {
    if (std::isinf(temperature_kelvin))
        return -4 * std::log(nm);
    const double x = kSecondRadiationNmK / (nm * temperature_kelvin);
    return -5 * std::log(nm) - x - std::log(-std::expm1(-x));
}

}  // namespace

double planck_radiance_w_m2_sr_nm(double wavelength_nm, double temperature_kelvin) {
    if (!(temperature_kelvin > 0))
        return std::isnan(temperature_kelvin) ? temperature_kelvin : 0;
    const auto [x, rest] = exponent(wavelength_nm, temperature_kelvin);
    const double lambda2 = wavelength_nm * wavelength_nm;
    const double scale = kFirstRadiation / (lambda2 * lambda2 * wavelength_nm);
    // In halves, so that exp(-x) need not be representable where the product is.
    const double half = std::exp(-x / 2);
    return scale * half * (half / -std::expm1(-x)) * (1 - rest);
}

NmSamples blackbody_power(double temperature_kelvin) {
    NmSamples out{};
    const auto nm_of = [](std::size_t i) { return kObserverFirstNm + static_cast<double>(i); };
    if (std::isinf(temperature_kelvin)) {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = 100 * std::pow(kObserverFirstNm / nm_of(i), 4);
        return out;
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = log_power(nm_of(i), temperature_kelvin);
    const double largest = *std::max_element(out.begin(), out.end());
    for (double& power : out)
        power = 100 * std::exp(power - largest);
    return out;
}

UltravioletSamples blackbody_ultraviolet(double temperature_kelvin) {
    double largest = log_power(kObserverFirstNm, temperature_kelvin);
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
        largest = std::max(largest, log_power(nm, temperature_kelvin));
    UltravioletSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = 100 * std::exp(log_power(kUltravioletFirstNm + static_cast<double>(i), temperature_kelvin) -
                                largest);
    return out;
}

}  // namespace osio
