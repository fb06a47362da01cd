// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/weights.h>

#include <cstddef>
#include <span>
#include <vector>

namespace osio {

/// The vector without negative elements that is nearest to another by a metric A, symmetric and positive definite:
///
///     min (x - x0)' A (x - x0),  x >= 0
///
/// which has A x >= A x0 with equality wherever x > 0. By pivots on the set of positive elements, all that are wrong at
/// a time; where those come to no end, by the algorithm NNLS, one at a time (Lawson and Hanson, Solving Least
/// Squares Problems, 1974, 23.3). NaN stays where it is, and the rest too.
class NonNegative {
  public:
    /// The metric outlives this.
    explicit NonNegative(const WeightMatrix& metric) : m_metric(metric) {}

    /// Replaces x0 by x.
    void project(std::span<double> x);

  private:
    [[nodiscard]] bool pivot(std::span<double> x);
    void descend(std::span<double> x);
    [[nodiscard]] std::size_t steepest(std::span<const double> x) const;
    void insert(std::size_t element);
    void solve(std::span<double> x);

    const WeightMatrix& m_metric;
    std::vector<std::size_t> m_positive;  ///< indices of elements that may be above zero
    std::vector<double> m_factor, m_right, m_solved;
    std::vector<double> m_wanted;  ///< A x0
};

}  // namespace osio
