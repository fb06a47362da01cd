// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/interpolation_basis.h>

#include <algorithm>
#include <array>

namespace osio {

namespace {

/// Walks 360, 361, ..., 830 nm; spread(nm, amount, weights) is called between the end bands.
template <class Spread>
std::vector<double> sum_at_1nm(std::span<const double> bands_nm, const NmSamples& weight,
                               Extrapolation extrapolation, Spread spread) {
    std::vector<double> out(bands_nm.size(), 0.0);
    for (std::size_t i = 0; i < weight.size(); ++i) {
        const double nm = kObserverFirstNm + static_cast<double>(i);
        if (nm >= bands_nm.front() && nm <= bands_nm.back())
            spread(nm, weight[i], out);
        else if (extrapolation == Extrapolation::Hold)
            (nm < bands_nm.front() ? out.front() : out.back()) += weight[i];
    }
    return out;
}

/// The value at X between samples 0 and 1 as coefficients of samples -2 ... 3: rows are a0 ... a5 of
/// y = a0 + a1 X + ... + a5 X^5, times 24 (CIE 167:2005, equation 1).
constexpr std::array<std::array<double, 6>, 6> kSprague{{{0, 0, 24, 0, 0, 0},
                                                         {2, -16, 0, 16, -2, 0},
                                                         {-1, 16, -30, 16, -1, 0},
                                                         {-9, 39, -70, 66, -33, 7},
                                                         {13, -64, 126, -124, 61, -12},
                                                         {-5, 25, -50, 50, -25, 5}}};

/// The samples two and one step before the first from the first six, times 209 (CIE 167:2005, equations
/// 2 and 3); after the last the same in reverse order.
constexpr std::array<std::array<double, 6>, 2> kBeyond{
    {{884, -1960, 3033, -2648, 1080, -180}, {508, -540, 488, -367, 144, -24}}};

std::array<double, 6> sprague_at(double x) {
    std::array<double, 6> out{};
    for (std::size_t sample = 0; sample < 6; ++sample) {
        double value = 0;
        for (std::size_t power = 6; power-- > 0;)
            value = value * x + kSprague[power][sample];
        out[sample] = value / 24;
    }
    return out;
}

/// Adds `amount` to a sample that may lie up to two steps before the first or after the last.
void add_to_sample(std::ptrdiff_t sample, double amount, std::vector<double>& weights) {
    const auto count = static_cast<std::ptrdiff_t>(weights.size());
    if (sample >= 0 && sample < count) {
        weights[static_cast<std::size_t>(sample)] += amount;
        return;
    }
    const bool before = sample < 0;
    const auto steps = before ? -sample : sample - count + 1;  // 1 or 2
    const auto& row = kBeyond[static_cast<std::size_t>(2 - steps)];
    for (std::size_t i = 0; i < row.size(); ++i)
        weights[before ? i : weights.size() - 1 - i] += row[i] / 209 * amount;
}

/// The interval that holds nm: its left band, never the last one.
std::size_t interval_of(std::span<const double> bands_nm, double nm) {
    const auto above = std::upper_bound(bands_nm.begin(), bands_nm.end(), nm);
    const auto i = static_cast<std::size_t>(above - bands_nm.begin());
    return std::min(i - 1, bands_nm.size() - 2);
}

/// Adds `amount` times the quintics' coefficients at nm, between the end bands.
void add_sprague(std::span<const double> bands_nm, double nm, double amount, std::vector<double>& out) {
    const double step = (bands_nm.back() - bands_nm.front()) / static_cast<double>(bands_nm.size() - 1);
    const double place = (nm - bands_nm.front()) / step;
    const auto i = std::min(static_cast<std::size_t>(place), bands_nm.size() - 2);
    const auto stencil = sprague_at(place - static_cast<double>(i));
    for (std::size_t s = 0; s < stencil.size(); ++s)
        add_to_sample(static_cast<std::ptrdiff_t>(i + s) - 2, stencil[s] * amount, out);
}

/// The same for Lagrange's cubics and parabolas.
void add_e2022(std::span<const double> bands_nm, double nm, double amount, std::vector<double>& out) {
    const std::size_t i = interval_of(bands_nm, nm);
    const std::size_t first = i == 0 ? 0 : i - 1;
    const std::size_t end = std::min(i + 3, bands_nm.size());
    for (std::size_t j = first; j < end; ++j) {
        double lagrange = 1;
        for (std::size_t m = first; m < end; ++m)
            if (m != j)
                lagrange *= (nm - bands_nm[m]) / (bands_nm[j] - bands_nm[m]);
        out[j] += lagrange * amount;
    }
}

void add_linear(std::span<const double> bands_nm, double nm, std::vector<double>& out) {
    const std::size_t i = interval_of(bands_nm, nm);
    const double share = (nm - bands_nm[i]) / (bands_nm[i + 1] - bands_nm[i]);
    out[i] = 1 - share;
    out[i + 1] = share;
}

}  // namespace

std::vector<double> sprague_integrals(std::span<const double> bands_nm, const NmSamples& weight,
                                      Extrapolation extrapolation) {
    return sum_at_1nm(
        bands_nm, weight, extrapolation,
        [&](double nm, double amount, std::vector<double>& out) { add_sprague(bands_nm, nm, amount, out); });
}

std::vector<double> e2022_integrals(std::span<const double> bands_nm, const NmSamples& weight,
                                    Extrapolation extrapolation) {
    return sum_at_1nm(
        bands_nm, weight, extrapolation,
        [&](double nm, double amount, std::vector<double>& out) { add_e2022(bands_nm, nm, amount, out); });
}

std::vector<double> interpolation_weights(Basis basis, std::span<const double> bands_nm, double nm,
                                          Extrapolation extrapolation) {
    std::vector<double> out(bands_nm.size(), 0.0);
    if (nm < bands_nm.front() || nm > bands_nm.back()) {
        if (extrapolation == Extrapolation::Hold)
            (nm < bands_nm.front() ? out.front() : out.back()) = 1;
        return out;
    }
    const auto at = std::lower_bound(bands_nm.begin(), bands_nm.end(), nm);
    if (*at == nm)
        out[static_cast<std::size_t>(at - bands_nm.begin())] = 1;
    else if (basis == Basis::Sprague)
        add_sprague(bands_nm, nm, 1, out);
    else if (basis == Basis::E2022)
        add_e2022(bands_nm, nm, 1, out);
    else
        add_linear(bands_nm, nm, out);
    return out;
}

}  // namespace osio
