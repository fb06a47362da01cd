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
/// which has A x >= A x0 with equality wherever x > 0 (Lawson and Hanson, Solving Least Squares Problems, 1974, 23.1). By
/// pivots on sets of positive elements, most of which change at a time; where those come to no end, x0
/// with zeros in place of what is negative. NaN stays where it is, and the rest too.
class NonNegative {
  public:
    /// The metric outlives this.
    explicit NonNegative(const WeightMatrix& metric) : m_metric(metric) {}

    /// Replaces x0 by x.
    void project(std::span<double> x);

  private:
    [[nodiscard]] bool pivot(std::span<const double> wanted, std::span<double> x);
    void solve(std::span<const double> wanted, std::span<double> x);

    const WeightMatrix& m_metric;
    std::vector<std::size_t> m_positive;  ///< indices of elements that may be above zero
    std::vector<double> m_factor, m_right, m_wanted, m_start;
};

}  // namespace osio
