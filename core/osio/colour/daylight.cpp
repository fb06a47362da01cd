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

/// S0 + M1 S1 + M2 S2 of one temperature.
class Daylight {
  public:
    static Result<Daylight> of(double correlated_kelvin) {
        if (!(correlated_kelvin >= kDaylightFirstKelvin && correlated_kelvin <= kDaylightLastKelvin))
            return fail(ErrorCode::Usage, "daylight of " + format_double(correlated_kelvin) +
                                              " K is not defined: expected 4000 to 25000 K; thermal light of "
                                              "any temperature is blackbody(kelvin)");
        return Daylight(daylight_x(correlated_kelvin));
    }

    [[nodiscard]] double power_at(double nm) const {
        return m_s0.linear_at(nm) + m_m1 * m_s1.linear_at(nm) + m_m2 * m_s2.linear_at(nm);
    }

  private:
    explicit Daylight(double x) {
        const double y = -3.000 * x * x + 2.870 * x - 0.275;
        const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
        m_m1 = rounded_to_thousandths((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
        m_m2 = rounded_to_thousandths((0.0300 - 31.4424 * x + 30.0717 * y) / m);
        const Table& table = *find_table("illuminants/d_series.csv");
        m_s0 = *table.column("S0");
        m_s1 = *table.column("S1");
        m_s2 = *table.column("S2");
    }

    double m_m1 = 0, m_m2 = 0;
    Spectrum m_s0, m_s1, m_s2;
};

template <class Samples>
Result<Samples> daylight_samples(double correlated_kelvin, int first_nm) {
    OSIO_TRY(const Daylight daylight, Daylight::of(correlated_kelvin));
    Samples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = daylight.power_at(first_nm + static_cast<double>(i));
    return out;
}

}  // namespace

Result<NmSamples> daylight_power(double correlated_kelvin) {
    return daylight_samples<NmSamples>(correlated_kelvin, kObserverFirstNm);
}

Result<UltravioletSamples> daylight_ultraviolet(double correlated_kelvin) {
    return daylight_samples<UltravioletSamples>(correlated_kelvin, kUltravioletFirstNm);
}

}  // namespace osio
