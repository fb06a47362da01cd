// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/bin_basis.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

constexpr double kFirstNm = kObserverFirstNm - 0.5;
constexpr double kLastNm = kObserverLastNm + 0.5;

double weight_at(const NmSamples& weight, double nm) {
    const double place = std::clamp(nm - kObserverFirstNm, 0.0, static_cast<double>(weight.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(place), weight.size() - 2);
    return weight[i] + (place - static_cast<double>(i)) * (weight[i + 1] - weight[i]);
}

struct Moments {
    double m0 = 0;  ///< integral of w
    double m1 = 0;  ///< integral of (lambda - centre) w
};

/// Between two whole nanometres w is a straight line and (lambda - centre) w a parabola, for which
/// Simpson's rule (1, 4, 1) h / 6 is exact.
Moments moments(const NmSamples& weight, double lo, double hi, double centre) {
    lo = std::max(lo, kFirstNm);
    hi = std::min(hi, kLastNm);
    Moments out;
    for (double a = lo; a < hi;) {
        const double b = std::min(hi, std::floor(a) + 1);
        const double middle = 0.5 * (a + b), h = b - a;
        const double wa = weight_at(weight, a), wm = weight_at(weight, middle), wb = weight_at(weight, b);
        out.m0 += h / 6 * (wa + 4 * wm + wb);
        out.m1 += h / 6 * ((a - centre) * wa + 4 * (middle - centre) * wm + (b - centre) * wb);
        a = b;
    }
    return out;
}

std::vector<Moments> all_moments(std::span<const double> edges_nm, const NmSamples& weight) {
    std::vector<Moments> out;
    for (std::size_t i = 0; i + 1 < edges_nm.size(); ++i)
        out.push_back(moments(weight, edges_nm[i], edges_nm[i + 1], 0.5 * (edges_nm[i] + edges_nm[i + 1])));
    return out;
}

void hold_ends(std::span<const double> edges_nm, const NmSamples& weight, std::vector<double>& out) {
    out.front() += moments(weight, kFirstNm, edges_nm.front(), 0).m0;
    out.back() += moments(weight, edges_nm.back(), kLastNm, 0).m0;
}

/// The first moment of bin i is `m1`: its slope, spread onto the two values that it is made of.
void spread_slope(std::span<const double> edges_nm, std::size_t i, double m1, Extrapolation extrapolation,
                  std::vector<double>& out) {
    const double h = (edges_nm.back() - edges_nm.front()) / static_cast<double>(out.size());
    const double share = m1 / (2 * h);
    const bool hold = extrapolation == Extrapolation::Hold;
    if (i + 1 < out.size() || hold)
        out[std::min(i + 1, out.size() - 1)] += share;
    if (i > 0 || hold)
        out[i > 0 ? i - 1 : 0] -= share;
}

}  // namespace

std::vector<double> bin_integrals(std::span<const double> edges_nm, const NmSamples& weight,
                                  Extrapolation extrapolation) {
    std::vector<double> out;
    for (const Moments& m : all_moments(edges_nm, weight))
        out.push_back(m.m0);
    if (extrapolation == Extrapolation::Hold)
        hold_ends(edges_nm, weight, out);
    return out;
}

std::vector<double> corrected_bin_integrals(std::span<const double> edges_nm, const NmSamples& weight,
                                            Extrapolation extrapolation) {
    const auto bins = all_moments(edges_nm, weight);
    std::vector<double> out = bin_integrals(edges_nm, weight, extrapolation);
    for (std::size_t i = 0; i < bins.size(); ++i)
        spread_slope(edges_nm, i, bins[i].m1, extrapolation, out);
    return out;
}

std::vector<double> bin_average_weights(std::span<const double> edges_nm, double low_nm, double high_nm,
                                        bool corrected, Extrapolation extrapolation) {
    const double width = high_nm - low_nm;
    std::vector<double> out(edges_nm.size() - 1, 0.0);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double a = std::max(low_nm, edges_nm[i]), b = std::min(high_nm, edges_nm[i + 1]);
        if (a >= b)
            continue;
        out[i] += (b - a) / width;
        const double offset = 0.5 * (a + b) - 0.5 * (edges_nm[i] + edges_nm[i + 1]);
        if (corrected && offset != 0)
            spread_slope(edges_nm, i, offset * (b - a) / width, extrapolation, out);
    }
    if (extrapolation == Extrapolation::Hold) {
        out.front() += std::max(0.0, std::min(high_nm, edges_nm.front()) - low_nm) / width;
        out.back() += std::max(0.0, high_nm - std::max(low_nm, edges_nm.back())) / width;
    }
    return out;
}

}  // namespace osio
