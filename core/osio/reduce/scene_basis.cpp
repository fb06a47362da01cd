// SPDX-License-Identifier: Apache-2.0
#include <osio/reduce/scene_basis.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osio {

namespace {

constexpr int kMostSweeps = 60;

/// Rows p and q of a matrix, turned.
void turn_rows(WeightMatrix& a, std::size_t p, std::size_t q, double c, double s) {
    for (std::size_t i = 0; i < a.bands(); ++i) {
        const double x = a.at(p, i), y = a.at(q, i);
        a.at(p, i) = c * x - s * y;
        a.at(q, i) = s * x + c * y;
    }
}

void turn_columns(WeightMatrix& a, std::size_t p, std::size_t q, double c, double s) {
    for (std::size_t i = 0; i < a.rows(); ++i) {
        const double x = a.at(i, p), y = a.at(i, q);
        a.at(i, p) = c * x - s * y;
        a.at(i, q) = s * x + c * y;
    }
}

/// The lower triangle L with L L' = A.
WeightMatrix cholesky(const WeightMatrix& a) {
    WeightMatrix out(a.rows(), a.rows());
    for (std::size_t i = 0; i < a.rows(); ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a.at(i, j);
            for (std::size_t k = 0; k < j; ++k)
                sum -= out.at(i, k) * out.at(j, k);
            out.at(i, j) = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / out.at(j, j);
        }
    return out;
}

}  // namespace

SymmetricEigen symmetric_eigen(WeightMatrix a) {
    const std::size_t n = a.rows();
    SymmetricEigen out{WeightMatrix(n, n), std::vector<double>(n)};
    for (std::size_t i = 0; i < n; ++i)
        out.vectors.at(i, i) = 1;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        bool turned = false;
        for (std::size_t p = 0; p + 1 < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                const double off = a.at(p, q);
                if (off * off <= 1e-30 * std::abs(a.at(p, p) * a.at(q, q)))
                    continue;
                // tan of the angle that makes the element zero: the smaller root.
                const double half = (a.at(q, q) - a.at(p, p)) / (2 * off);
                const double t = std::copysign(1.0, half) / (std::abs(half) + std::hypot(1.0, half));
                const double c = 1 / std::hypot(1.0, t), s = t * c;
                turn_rows(a, p, q, c, s);
                turn_columns(a, p, q, c, s);
                turn_columns(out.vectors, p, q, c, s);
                turned = true;
            }
        if (!turned)
            break;
    }
    for (std::size_t i = 0; i < n; ++i)
        out.values[i] = a.at(i, i);
    return out;
}

SceneFit::SceneFit(std::span<const Demand> demands, const BinFit& fit, double fidelity,
                   const SpectrumSample& sample)
    : m_all(fit.columns()) {
    for (std::size_t column = 0; column < m_all; ++column)
        if (std::any_of(demands.begin(), demands.end(),
                        [column](const Demand& demand) { return demand.plan.weights.needs(column); }))
            m_columns.push_back(column);
    const std::size_t n = m_columns.size();
    const WeightMatrix& rows = fit.bands().demanded;
    WeightMatrix metric(n, n), scatter(n, n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t row = 0; row < rows.rows(); ++row)
                metric.at(i, j) += rows.at(row, m_columns[i]) * rows.at(row, m_columns[j]);
        metric.at(i, i) += fidelity * fidelity;
    }
    for (std::size_t pixel = 0; pixel < sample.size(); ++pixel)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                scatter.at(i, j) += sample.pixel(pixel)[m_columns[i]] * sample.pixel(pixel)[m_columns[j]];
    m_lower = cholesky(metric);
    const auto times = [n](const WeightMatrix& a, bool transposed, const WeightMatrix& b) {
        WeightMatrix out(n, n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t j = 0; j < n; ++j)
                    out.at(i, j) += (transposed ? a.at(k, i) : a.at(i, k)) * b.at(k, j);
        return out;
    };
    SymmetricEigen eigen = symmetric_eigen(times(times(m_lower, true, scatter), false, m_lower));
    m_vectors = std::move(eigen.vectors);
    m_order.resize(n);
    std::iota(m_order.begin(), m_order.end(), std::size_t{0});
    std::stable_sort(m_order.begin(), m_order.end(),
                     [&eigen](std::size_t a, std::size_t b) { return eigen.values[a] > eigen.values[b]; });
}

SceneBasis SceneFit::first(std::size_t count) const {
    const std::size_t n = m_columns.size();
    SceneBasis out{WeightMatrix(n, count), WeightMatrix(count, m_all)};
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t vector = m_order[k];
        for (std::size_t i = n; i-- > 0;) {
            double sum = m_vectors.at(i, vector);
            for (std::size_t j = i + 1; j < n; ++j)
                sum -= m_lower.at(j, i) * out.expansion.at(j, k);
            out.expansion.at(i, k) = sum / m_lower.at(i, i);
            double coefficient = 0;
            for (std::size_t j = 0; j <= i; ++j)
                coefficient += m_lower.at(i, j) * m_vectors.at(j, vector);
            out.coefficients.at(k, m_columns[i]) = coefficient;
        }
    }
    return out;
}

}  // namespace osio
