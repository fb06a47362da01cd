// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/reduce/bin_search.h>

#include <cstddef>
#include <span>
#include <vector>

namespace osio {

/// Spectra of one scene as sums of a few curves: s = expansion c, c = coefficients s.
struct SceneBasis {
    WeightMatrix expansion;     ///< bands x count
    WeightMatrix coefficients;  ///< count x the original's columns
};

/// Curves that lose least of a sample's spectra in the metric in which colours count:
///
///     min sum |s - expansion c|_G^2,  |e|_G^2 = e' G e,  G = W'J'JW + fidelity^2 I
///
/// with W and J as BinFit has them. With G = L L' and C the sum of s s', the curves are L'^-1 u and the coefficients
/// u' L' s for the eigenvectors u of L' C L with the largest eigenvalues (Eckart and Young, Psychometrika 1, 1936).
class SceneFit {
  public:
    /// Bands that no demand needs are left out.
    SceneFit(std::span<const Demand> demands, const BinFit& fit, double fidelity,
             const SpectrumSample& sample);

    /// Which of the original's columns the bands are.
    [[nodiscard]] const std::vector<std::size_t>& columns() const { return m_columns; }

    /// The first `count` of the curves, 1 to columns().size().
    [[nodiscard]] SceneBasis first(std::size_t count) const;

  private:
    std::size_t m_all = 0;  ///< columns of the original
    std::vector<std::size_t> m_columns;
    WeightMatrix m_lower;              ///< L
    WeightMatrix m_vectors;            ///< an eigenvector a column
    std::vector<std::size_t> m_order;  ///< of the eigenvectors, the largest eigenvalue first
};

/// Eigenvectors, one a column, and eigenvalues of a symmetric matrix, by Jacobi's rotations in cycles over its elements.
struct SymmetricEigen {
    WeightMatrix vectors;
    std::vector<double> values;
};

[[nodiscard]] SymmetricEigen symmetric_eigen(WeightMatrix matrix);

}  // namespace osio
