// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/response_basis.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osio {

namespace {

/// Wavelength in units in which 360-830 nm is -1 to 1: keeps the equations well conditioned.
double scaled(std::size_t i) {
    return 2 * static_cast<double>(i) / static_cast<double>(kObserverSampleCount - 1) - 1;
}

/// Averages under a response, as a list of the samples where it is not zero.
struct Average {
    std::vector<std::size_t> at;
    std::vector<double> share;  ///< adds up to 1
    double centroid = 0;        ///< scaled
};

Average average_of(const NmSamples& response) {
    const double sum = std::accumulate(response.begin(), response.end(), 0.0);
    Average out;
    for (std::size_t i = 0; i < response.size(); ++i)
        if (response[i] != 0) {
            out.at.push_back(i);
            out.share.push_back(response[i] / sum);
            out.centroid += response[i] / sum * scaled(i);
        }
    return out;
}

/// (K s)(x) = sum over y of K(x, y) s(y).
double smoothed(const Average& s, double x) {
    double sum = 0;
    for (std::size_t j = 0; j < s.at.size(); ++j) {
        const double d = std::abs(x - scaled(s.at[j]));
        sum += s.share[j] * d * d * d / 12;
    }
    return sum;
}

/// Solves the symmetric system in place by Gauss with row pivots; false where it is singular.
bool solve(std::vector<std::vector<double>>& m, std::vector<double>& rhs) {
    constexpr double kSmallestPivot = 1e-13;
    const std::size_t n = rhs.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t r = k + 1; r < n; ++r)
            if (std::abs(m[r][k]) > std::abs(m[pivot][k]))
                pivot = r;
        if (!(std::abs(m[pivot][k]) > kSmallestPivot))
            return false;
        std::swap(m[k], m[pivot]);
        std::swap(rhs[k], rhs[pivot]);
        for (std::size_t r = k + 1; r < n; ++r) {
            const double factor = m[r][k] / m[k][k];
            for (std::size_t c = k; c < n; ++c)
                m[r][c] -= factor * m[k][c];
            rhs[r] -= factor * rhs[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t c = k + 1; c < n; ++c)
            rhs[k] -= m[k][c] * rhs[c];
        rhs[k] /= m[k][k];
    }
    return true;
}

/// K s at every whole nanometre.
std::vector<double> smoothed_at_1nm(const Average& s) {
    std::vector<double> out;
    for (std::size_t i = 0; i < kObserverSampleCount; ++i)
        out.push_back(smoothed(s, scaled(i)));
    return out;
}

}  // namespace

std::vector<double> response_integrals(std::span<const NmSamples> responses, const NmSamples& weight,
                                       Extrapolation extrapolation) {
    std::vector<Average> averages;
    for (const NmSamples& response : responses)
        averages.push_back(average_of(response));
    const auto [lowest, highest] =
        std::minmax_element(averages.begin(), averages.end(),
                            [](const Average& a, const Average& b) { return a.centroid < b.centroid; });

    const std::size_t n = averages.size();
    std::vector<std::vector<double>> k_s;
    for (const Average& average : averages)
        k_s.push_back(smoothed_at_1nm(average));

    std::vector<std::vector<double>> m(n + 2, std::vector<double>(n + 2, 0.0));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < averages[i].at.size(); ++j)
            for (std::size_t k = 0; k <= i; ++k)
                m[i][k] += averages[i].share[j] * k_s[k][averages[i].at[j]];
        for (std::size_t k = 0; k <= i; ++k)
            m[k][i] = m[i][k];
        m[i][n] = m[n][i] = 1;
        m[i][n + 1] = m[n + 1][i] = averages[i].centroid;
    }

    // The functional: the integral of weight x f, with f kept at the outermost centroids' values beyond.
    std::vector<double> rhs(n + 2, 0.0);
    const auto add_place = [&](double x, double amount, auto k_s_of) {
        for (std::size_t i = 0; i < n; ++i)
            rhs[i] += amount * k_s_of(i);
        rhs[n] += amount;
        rhs[n + 1] += amount * x;
    };
    double below = 0, above = 0;
    for (std::size_t at = 0; at < weight.size(); ++at) {
        const double x = scaled(at);
        if (x < lowest->centroid)
            below += weight[at];
        else if (x > highest->centroid)
            above += weight[at];
        else
            add_place(x, weight[at], [&](std::size_t i) { return k_s[i][at]; });
    }
    if (extrapolation == Extrapolation::Hold)
        for (const auto& [x, amount] :
             {std::pair(lowest->centroid, below), std::pair(highest->centroid, above)})
            add_place(x, amount, [&, x = x](std::size_t i) { return smoothed(averages[i], x); });
    if (!solve(m, rhs))
        return {};
    rhs.resize(n);
    return rhs;
}

NmSamples gaussian_response(double centre_nm, double fwhm_nm) {
    NmSamples out{};
    const double k = 4 * std::log(2.0) / (fwhm_nm * fwhm_nm);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double d = kObserverFirstNm + static_cast<double>(i) - centre_nm;
        out[i] = std::exp(-k * d * d);
    }
    return out;
}

}  // namespace osio
