// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/plot_axis.h>
#include <tools/osiotool/spectrum_plot.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace osio::tool {

namespace {

constexpr double kWidth = 720, kHeight = 420;                       // px
constexpr double kLeft = 72, kRight = 24, kTop = 40, kBottom = 56;  // margins, px

std::string grid(const PlotAxis& x, const PlotAxis& y) {
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
    const PlotAxis x(spread.front().wavelength_nm, spread.back().wavelength_nm, kLeft, kWidth - kRight);
    const PlotAxis y(low, high, kHeight - kBottom, kTop);
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
