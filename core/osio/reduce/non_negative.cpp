// SPDX-License-Identifier: Apache-2.0
#include <osio/reduce/non_negative.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// Gradients within rounding of zero move nothing.
constexpr double kRounding = 1e-12;

}  // namespace

void NonNegative::project(std::span<double> x) {
    const std::size_t n = x.size();
    if (std::none_of(x.begin(), x.end(), [](double v) { return v < 0; }) ||
        !std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); }))
        return;
    m_start.assign(x.begin(), x.end());
    m_wanted.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            m_wanted[i] += m_metric.at(i, j) * x[j];
    if (!pivot(m_wanted, x))
        for (std::size_t i = 0; i < n; ++i)
            x[i] = std::max(m_start[i], 0.0);
}

bool NonNegative::pivot(std::span<const double> wanted, std::span<double> x) {
    const std::size_t n = x.size();
    m_positive.clear();
    for (std::size_t i = 0; i < n; ++i)
        if (x[i] > 0)
            m_positive.push_back(i);
    for (std::size_t attempt = 0; attempt < 4 * n; ++attempt) {
        solve(wanted, x);
        const std::size_t before = m_positive.size();
        std::erase_if(m_positive, [x](std::size_t i) { return !(x[i] > 0); });
        if (m_positive.size() < before)
            continue;
        std::size_t steepest = n;
        double most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            if (x[i] > 0)
                continue;
            double slope = wanted[i];
            for (const std::size_t j : m_positive)
                slope -= m_metric.at(i, j) * x[j];
            // Relative to what the element alone would weigh.
            if (slope > kRounding * (std::abs(wanted[i]) + m_metric.at(i, i)) && slope > most) {
                most = slope;
                steepest = i;
            }
        }
        if (steepest == n)
            return true;
        m_positive.insert(std::lower_bound(m_positive.begin(), m_positive.end(), steepest), steepest);
    }
    return false;
}

void NonNegative::solve(std::span<const double> wanted, std::span<double> x) {
    const std::size_t n = m_positive.size();
    m_factor.assign(n * n, 0.0);
    m_right.resize(n);
    // Cholesky, row by row, and the forward substitution with it.
    for (std::size_t i = 0; i < n; ++i) {
        double right = wanted[m_positive[i]];
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = m_metric.at(m_positive[i], m_positive[j]);
            for (std::size_t k = 0; k < j; ++k)
                sum -= m_factor[i * n + k] * m_factor[j * n + k];
            m_factor[i * n + j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / m_factor[j * n + j];
        }
        for (std::size_t k = 0; k < i; ++k)
            right -= m_factor[i * n + k] * m_right[k];
        m_right[i] = right / m_factor[i * n + i];
    }
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t i = n; i-- > 0;) {
        double sum = m_right[i];
        for (std::size_t k = i + 1; k < n; ++k)
            sum -= m_factor[k * n + i] * x[m_positive[k]];
        x[m_positive[i]] = sum / m_factor[i * n + i];
    }
}

}  // namespace osio
