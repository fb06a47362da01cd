// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/spectrum_plot.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace osio::tool {

namespace {

constexpr double kWidth = 720, kHeight = 420;                       // px
constexpr double kLeft = 72, kRight = 24, kTop = 40, kBottom = 56;  // margins, px

/// A range of values along a side of the picture.
class Axis {
  public:
    /// `from` and `to`: pixels of the lowest and highest value.
    Axis(double low, double high, double from, double to) : m_low(low), m_high(high), m_from(from), m_to(to) {
        if (m_low == m_high) {
            const double room = m_low == 0 ? 1 : std::abs(m_low) / 2;
            m_low -= room;
            m_high += room;
        }
    }

    [[nodiscard]] double at(double value) const {
        return m_from + (value - m_low) / (m_high - m_low) * (m_to - m_from);
    }

    /// Multiples of 1, 2 or 5 times a power of ten inside the range, about six of them.
    [[nodiscard]] std::vector<double> ticks() const {
        const double rough = (m_high - m_low) / 6, power = std::pow(10, std::floor(std::log10(rough)));
        const double digits = rough / power;
        const double step = power * (digits > 5 ? 10 : digits > 2 ? 5 : digits > 1 ? 2 : 1);
        std::vector<double> out;
        for (double n = std::ceil(m_low / step - 1e-9); n * step <= m_high + 1e-9 * step; ++n)
            out.push_back(n * step);
        return out;
    }

  private:
    double m_low, m_high, m_from, m_to;
};

std::string grid(const Axis& x, const Axis& y) {
    std::string out;
    for (const double nm : x.ticks())
        out +=
            fmt::format("<line x1=\"{0:.2f}\" y1=\"{1}\" x2=\"{0:.2f}\" y2=\"{2}\"/>\n"
                        "<text x=\"{0:.2f}\" y=\"{3}\" stroke=\"none\" text-anchor=\"middle\">{4:g}</text>\n",
                        x.at(nm), kTop, kHeight - kBottom, kHeight - kBottom + 18, nm);
    for (const double value : y.ticks())
        out += fmt::format(
            "<line x1=\"{1}\" y1=\"{0:.2f}\" x2=\"{2}\" y2=\"{0:.2f}\"/>\n"
            "<text x=\"{3}\" y=\"{0:.2f}\" dy=\"4\" stroke=\"none\" text-anchor=\"end\">{4:.6g}</text>\n",
            y.at(value), kLeft, kWidth - kRight, kLeft - 8, std::abs(value) < 1e-12 ? 0 : value);
    return "<g stroke=\"#ddd\" fill=\"#444\">\n" + out + "</g>\n";
}

}  // namespace

std::string spectrum_plot(const std::vector<image::BandSpread>& spread, const std::string& title,
                          const std::string& quantity) {
    double low = 0, high = spread.front().maximum;
    for (const image::BandSpread& band : spread) {
        low = std::min(low, band.minimum);
        high = std::max(high, band.maximum);
    }
    const Axis x(spread.front().wavelength_nm, spread.back().wavelength_nm, kLeft, kWidth - kRight);
    const Axis y(low, high, kHeight - kBottom, kTop);
    std::string line, marks, below, above;
    for (const image::BandSpread& band : spread) {
        const double at = x.at(band.wavelength_nm);
        line += fmt::format("{:.2f},{:.2f} ", at, y.at(band.mean));
        above += fmt::format("{:.2f},{:.2f} ", at, y.at(band.maximum));
        below.insert(0, fmt::format("{:.2f},{:.2f} ", at, y.at(band.minimum)));
        marks += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.5\"><title>{:g} nm: {:.6g}</title>"
                             "</circle>\n",
                             at, y.at(band.mean), band.wavelength_nm, band.mean);
    }
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
                       "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
                       "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
                       "<text x=\"{2}\" y=\"24\" font-size=\"14\">{3}</text>\n",
                       kWidth, kHeight, kLeft, escaped_xml(title)) +
           grid(x, y) +
           fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">wavelength, nm</text>\n"
                       "<text transform=\"translate(18 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       (kLeft + kWidth - kRight) / 2, kHeight - 14, (kTop + kHeight - kBottom) / 2,
                       escaped_xml(quantity)) +
           fmt::format("<polygon points=\"{}{}\" fill=\"#2a6fb0\" fill-opacity=\"0.2\"/>\n"
                       "<polyline points=\"{}\" fill=\"none\" stroke=\"#2a6fb0\" stroke-width=\"1.5\"/>\n"
                       "<g fill=\"#2a6fb0\">\n{}</g>\n</svg>\n",
                       above, below, line, marks);
}

}  // namespace osio::tool
