// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/difference.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osio {

namespace {

constexpr double kHalfTurnMarginDeg = 1e-9;

double radians(double degrees) {
    return degrees * (std::numbers::pi / 180);
}

double seventh_power(double x) {
    const double squared = x * x;
    return squared * squared * squared * x;
}

/// sqrt(C^7 / (C^7 + 25^7)), written so that no chroma overflows.
double chroma_share(double chroma) {
    return 1 / std::sqrt(1 + seventh_power(25 / chroma));
}

}  // namespace

double delta_e_2000(const Lab& a, const Lab& b) {
    // a' = (1 + G) a makes greys of high chroma weigh like the rest.
    const double mean_chroma = (std::hypot(a.a, a.b) + std::hypot(b.a, b.b)) / 2;
    const double stretch = 1 + 0.5 * (1 - (mean_chroma > 0 ? chroma_share(mean_chroma) : 0));
    const Lch p = lch_of({a.l, stretch * a.a, a.b});
    const Lch q = lch_of({b.l, stretch * b.a, b.b});

    double turn_deg = 0;
    double mean_hue_deg = p.h_deg + q.h_deg;  // where one has no chroma, the other's hue
    if (p.c > 0 && q.c > 0) {
        turn_deg = q.h_deg - p.h_deg;
        mean_hue_deg /= 2;
        if (std::abs(turn_deg) > 180 + kHalfTurnMarginDeg) {
            turn_deg += turn_deg > 0 ? -360 : 360;
            mean_hue_deg += mean_hue_deg < 180 ? 180 : -180;
        }
    }
    const double lightness = q.l - p.l;
    const double chroma = q.c - p.c;
    const double hue = 2 * std::sqrt(p.c) * std::sqrt(q.c) * std::sin(radians(turn_deg) / 2);

    const double middle = (p.l + q.l) / 2 - 50;
    const double mean_c = (p.c + q.c) / 2;
    const double t =
        1 - 0.17 * std::cos(radians(mean_hue_deg - 30)) + 0.24 * std::cos(radians(2 * mean_hue_deg)) +
        0.32 * std::cos(radians(3 * mean_hue_deg + 6)) - 0.20 * std::cos(radians(4 * mean_hue_deg - 63));
    const double s_l = 1 + 0.015 * middle * (middle / std::sqrt(20 + middle * middle));
    const double s_c = 1 + 0.045 * mean_c;
    const double s_h = 1 + 0.015 * mean_c * t;
    const double blue = (mean_hue_deg - 275) / 25;
    const double rotation =
        (mean_c > 0 ? -2 * chroma_share(mean_c) : 0) * std::sin(radians(60 * std::exp(-blue * blue)));

    const double dl = lightness / s_l, dc = chroma / s_c, dh = hue / s_h;
    const double squared = dl * dl + dc * dc + dh * dh + rotation * dc * dh;
    return squared < 0 ? 0 : std::sqrt(squared);  // NaN stays NaN
}

DifferenceSummary differences_of(std::span<const Vector3> found, std::span<const Vector3> wanted,
                                 const Vector3& white) {
    DifferenceSummary out;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double delta = delta_e_2000(lab_of(found[i], white), lab_of(wanted[i], white));
        out.mean += delta / static_cast<double>(found.size());
        out.max = std::max(out.max, delta);
    }
    return out;
}

}  // namespace osio
