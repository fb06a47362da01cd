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
    m_wanted.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            m_wanted[i] += m_metric.at(i, j) * x[j];
    if (!pivot(x))
        descend(x);
}

bool NonNegative::pivot(std::span<double> x) {
    m_positive.clear();
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] > 0)
            m_positive.push_back(i);
    for (std::size_t attempt = 0; attempt < 2 * x.size(); ++attempt) {
        solve(x);
        const std::size_t before = m_positive.size();
        std::erase_if(m_positive, [x](std::size_t i) { return !(x[i] > 0); });
        if (m_positive.size() < before)
            continue;
        const std::size_t next = steepest(x);
        if (next == x.size())
            return true;
        insert(next);
    }
    return false;
}

void NonNegative::descend(std::span<double> x) {
    std::fill(x.begin(), x.end(), 0.0);
    m_positive.clear();
    m_solved.resize(x.size());
    // It ends by itself, since the distance falls with every element that comes in; but for rounding.
    for (std::size_t attempt = 0; attempt < 10 * x.size(); ++attempt) {
        const std::size_t next = steepest(x);
        if (next == x.size())
            return;
        insert(next);
        while (!m_positive.empty()) {
            solve(m_solved);
            double step = 1;
            std::size_t blocks = x.size();
            for (const std::size_t i : m_positive)
                if (!(m_solved[i] > 0) && x[i] / (x[i] - m_solved[i]) < step) {
                    step = x[i] / (x[i] - m_solved[i]);
                    blocks = i;
                }
            for (const std::size_t i : m_positive)
                x[i] = std::max(x[i] + step * (m_solved[i] - x[i]), 0.0);
            if (blocks == x.size())
                break;
            x[blocks] = 0;
            std::erase_if(m_positive, [x](std::size_t i) { return !(x[i] > 0); });
        }
    }
}

/// The element at zero whose growth shortens the distance most; the size where none does.
std::size_t NonNegative::steepest(std::span<const double> x) const {
    std::size_t out = x.size();
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] > 0)
            continue;
        double slope = m_wanted[i];
        for (const std::size_t j : m_positive)
            slope -= m_metric.at(i, j) * x[j];
        // Relative to what the element alone would weigh.
        if (slope > kRounding * (std::abs(m_wanted[i]) + m_metric.at(i, i)) && slope > most) {
            most = slope;
            out = i;
        }
    }
    return out;
}

void NonNegative::insert(std::size_t element) {
    m_positive.insert(std::lower_bound(m_positive.begin(), m_positive.end(), element), element);
}

/// The nearest to x0 among the vectors that are zero elsewhere.
void NonNegative::solve(std::span<double> x) {
    const std::size_t n = m_positive.size();
    m_factor.assign(n * n, 0.0);
    m_right.resize(n);
    // Cholesky, row by row, and the forward substitution with it.
    for (std::size_t i = 0; i < n; ++i) {
        double right = m_wanted[m_positive[i]];
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
