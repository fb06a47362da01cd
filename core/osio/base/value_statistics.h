// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace osio {

/// Mean, extremes and percentiles of any number of values in 8 MB. Percentiles are taken from counts
/// of floats that share their sign, exponent and first 11 bits of fraction, so they are right to 2^-12
/// of their value; the rest is in double. The order of values matters to the last bits of the mean only.
class ValueStatistics {
  public:
    ValueStatistics();

    /// NaN and infinities are counted apart and go into nothing else.
    void add(double value);

    [[nodiscard]] std::uint64_t count() const { return m_count; }

    [[nodiscard]] std::uint64_t undefined_count() const { return m_undefined; }

    /// Zero where there is no value, as the rest.
    [[nodiscard]] double mean() const;

    [[nodiscard]] double minimum() const { return m_minimum; }

    [[nodiscard]] double maximum() const { return m_maximum; }

    /// The least value that at least `percent` (0 to 100) of the values do not exceed.
    [[nodiscard]] double percentile(double percent) const;

  private:
    std::vector<std::uint64_t> m_buckets;
    std::uint64_t m_count = 0;
    std::uint64_t m_undefined = 0;
    double m_sum = 0;
    double m_minimum = 0;
    double m_maximum = 0;
};

}  // namespace osio
