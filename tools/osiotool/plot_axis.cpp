// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/plot_axis.h>

#include <cmath>

namespace osio::tool {

PlotAxis::PlotAxis(double low, double high, double from, double to)
    : m_low(low), m_high(high), m_from(from), m_to(to) {
    if (m_low == m_high) {
        const double room = m_low == 0 ? 1 : std::abs(m_low) / 2;
        m_low -= room;
        m_high += room;
    }
}

std::vector<double> PlotAxis::ticks(int count) const {
    const double rough = (m_high - m_low) / count, power = std::pow(10, std::floor(std::log10(rough)));
    const double digits = rough / power;
    const double step = power * (digits > 5 ? 10 : digits > 2 ? 5 : digits > 1 ? 2 : 1);
    std::vector<double> out;
    for (double n = std::ceil(m_low / step - 1e-9); n * step <= m_high + 1e-9 * step; ++n)
        out.push_back(n * step);
    return out;
}

}  // namespace osio::tool
