// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/cct.h>
#include <osio/colour/observer.h>

#include <cmath>

namespace osio {

namespace {

/// h c / k, nm K; all three exact (SI 2019).
constexpr double kSecondRadiationConstantNmK = 6.62607015e-34 * kSpeedOfLightMPerS / 1.380649e-23 * 1e9;

/// Steps of reciprocal temperature that bracket the nearest point: 10 mired each.
constexpr int kSteps = 99;

const Observer& observer() {
    static const Observer kObserver = find_observer("cie1931").value();
    return kObserver;
}

/// Squared distance in CIE 1960 (u, v).
double squared_distance(const UniformChromaticity& a, const UniformChromaticity& b) {
    const double du = a.u - b.u, dv = 2 * (a.v - b.v) / 3;
    return du * du + dv * dv;
}

}  // namespace

UniformChromaticity planckian_chromaticity(double temperature_k) {
    // Relative to 560 nm, so that no power overflows; exp(-x)/-expm1(-x) is 1/(exp(x)-1) without
    // overflow at low and without cancellation at high temperatures.
    constexpr double kReferenceNm = 560;
    const auto log_power = [temperature_k](double nm) {
        const double x = kSecondRadiationConstantNmK / (nm * temperature_k);
        return -5 * std::log(nm / kReferenceNm) - x - std::log(-std::expm1(-x));
    };
    const double reference = log_power(kReferenceNm);
    Vector3 xyz{};
    for (std::size_t i = 0; i < kObserverSampleCount; ++i) {
        const double power = std::exp(log_power(kObserverFirstNm + static_cast<double>(i)) - reference);
        for (std::size_t c = 0; c < 3; ++c)
            xyz[c] += power * observer().curves[c][i];
    }
    return uv_of(xyz, xyz);
}

Result<ColourTemperature> colour_temperature(const UniformChromaticity& colour) {
    const auto distance = [&colour](double mired) {
        return squared_distance(colour, planckian_chromaticity(1e6 / mired));
    };
    const double first = 1e6 / kHighestCctK, last = 1e6 / kLowestCctK;
    const double step = (last - first) / kSteps;
    int nearest = 0;
    double least = distance(first);
    for (int i = 1; i <= kSteps; ++i)
        if (const double d = distance(first + i * step); d < least) {
            least = d;
            nearest = i;
        }
    if (!(least <= kFarthestDuv * kFarthestDuv) || nearest == 0 || nearest == kSteps)
        return fail(ErrorCode::InvalidGrid, "u' " + format_fixed(colour.u, 4) + ", v' " +
                                                format_fixed(colour.v, 4) +
                                                " has no correlated colour temperature: expected within 0.05 "
                                                "in (u, v) of the Planckian locus, 1000 K to 100000 K");

    // Golden sections keep the least of three points inside the bracket.
    constexpr double kGolden = 0.6180339887498949;
    double low = first + (nearest - 1) * step, high = first + (nearest + 1) * step;
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double at_left = distance(left), at_right = distance(right);
    constexpr int kSections = 44;  // 20 mired x 0.618^44 is 1.3e-8 mired
    for (int i = 0; i < kSections; ++i) {
        if (at_left < at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - kGolden * (high - low);
            at_left = distance(left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + kGolden * (high - low);
            at_right = distance(right);
        }
    }
    const double mired = (low + high) / 2;
    const UniformChromaticity locus = planckian_chromaticity(1e6 / mired);
    const double duv = std::sqrt(squared_distance(colour, locus));
    return ColourTemperature{1e6 / mired, colour.v < locus.v ? -duv : duv};
}

}  // namespace osio
