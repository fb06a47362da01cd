// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace osio::tool {

/// A range of values along a side of a picture.
class PlotAxis {
  public:
    /// `from` and `to`: pixels of the lowest and highest value. A range of no width is given some.
    PlotAxis(double low, double high, double from, double to);

    /// Pixels of a value.
    [[nodiscard]] double at(double value) const {
        return m_from + (value - m_low) / (m_high - m_low) * (m_to - m_from);
    }

    /// Multiples of 1, 2 or 5 times a power of ten inside the range, about `count` of them.
    [[nodiscard]] std::vector<double> ticks(int count = 6) const;

  private:
    double m_low, m_high, m_from, m_to;
};

}  // namespace osio::tool
