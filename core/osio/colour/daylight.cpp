// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/daylight.h>
#include <osio/data/tables.h>

#include <cmath>

namespace osio {

namespace {

double rounded_to_thousandths(double value) {
    return std::round(value * 1000) / 1000;
}

/// Chromaticity x of daylight, CIE 15:2018, equations 4.1 and 4.2.
double daylight_x(double kelvin) {
    const double t = 1000 / kelvin;
    return kelvin <= 7000 ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                          : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
}

}  // namespace

Result<NmSamples> daylight_power(double correlated_kelvin) {
    if (!(correlated_kelvin >= kDaylightFirstKelvin && correlated_kelvin <= kDaylightLastKelvin))
        return fail(ErrorCode::Usage, "daylight of " + format_double(correlated_kelvin) +
                                          " K is not defined: expected 4000 to 25000 K; thermal light of "
                                          "any temperature is blackbody(kelvin)");
    const double x = daylight_x(correlated_kelvin);
    const double y = -3.000 * x * x + 2.870 * x - 0.275;
    const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
    const double m1 = rounded_to_thousandths((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
    const double m2 = rounded_to_thousandths((0.0300 - 31.4424 * x + 30.0717 * y) / m);
    const Table& table = *find_table("illuminants/d_series.csv");
    const Spectrum s0 = *table.column("S0"), s1 = *table.column("S1"), s2 = *table.column("S2");
    NmSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double nm = kObserverFirstNm + static_cast<double>(i);
        out[i] = s0.linear_at(nm) + m1 * s1.linear_at(nm) + m2 * s2.linear_at(nm);
    }
    return out;
}

}  // namespace osio
