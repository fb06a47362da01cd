// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace osio {

/// One row of doubles for each output, one column for each band or pair of bands. A weight of zero means that the
/// band is not read for that output: 0 x Inf never becomes NaN.
class WeightMatrix {
  public:
    WeightMatrix() = default;

    WeightMatrix(std::size_t rows, std::size_t bands)
        : m_rows(rows), m_bands(bands), m_values(rows * bands, 0.0) {}

    [[nodiscard]] std::size_t rows() const { return m_rows; }

    [[nodiscard]] std::size_t bands() const { return m_bands; }

    [[nodiscard]] double at(std::size_t row, std::size_t band) const {
        return m_values[row * m_bands + band];
    }

    [[nodiscard]] double& at(std::size_t row, std::size_t band) { return m_values[row * m_bands + band]; }

    [[nodiscard]] std::span<const double> row(std::size_t row) const {
        return std::span<const double>(m_values).subspan(row * m_bands, m_bands);
    }

    /// True where some output needs the band.
    [[nodiscard]] bool needs(std::size_t band) const {
        for (std::size_t row = 0; row < m_rows; ++row)
            if (at(row, band) != 0)
                return true;
        return false;
    }

    /// Adds the rows of another matrix over the same bands; a matrix without rows takes any bands.
    void append(const WeightMatrix& below) {
        m_rows += below.m_rows;
        m_bands = below.m_bands;
        m_values.insert(m_values.end(), below.m_values.begin(), below.m_values.end());
    }

  private:
    std::size_t m_rows = 0;
    std::size_t m_bands = 0;
    std::vector<double> m_values;
};

}  // namespace osio
