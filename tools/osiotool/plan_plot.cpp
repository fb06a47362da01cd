// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/plan_plot.h>
#include <tools/osiotool/plot_axis.h>
#include <tools/osiotool/report.h>

#include <formats/image/grey_budget.h>

#include <osio/base/text.h>
#include <osio/collapse/basis_spread.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osio::tool {

namespace {

constexpr double kFirstNm = kObserverFirstNm, kLastNm = kObserverLastNm;
// All in px.
constexpr double kWidth = 860, kLeft = 96, kRight = 24;
constexpr double kLightTop = 92, kLightHeight = 120;
constexpr double kBandTop = 240, kBandHeight = 22;
constexpr double kWeightTop = 298, kWeightHeight = 220;
constexpr double kBudgetTop = 596, kBudgetRow = 20, kBudgetLeft = 210;

constexpr std::array<const char*, 4> kOutputColours{"#c0392b", "#2e8b57", "#2a6fb0", "#7d5ba6"};

const PlotAxis& wavelengths() {
    static const PlotAxis axis(kFirstNm, kLastNm, kLeft, kWidth - kRight);
    return axis;
}

std::string text_at(double x, double y, const std::string& text, const char* more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, more, escaped_xml(text));
}

/// Lines for round wavelengths from one height to another.
std::string wavelength_grid(double top, double bottom) {
    std::string out;
    for (const double nm : wavelengths().ticks(10))
        out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#e4e4e4\"/>\n",
                           wavelengths().at(nm), top, bottom);
    return out;
}

std::string curve(const NmSamples& samples, const PlotAxis& y, const char* style) {
    std::string points;
    for (std::size_t i = 0; i < samples.size(); ++i)
        points += fmt::format("{:.1f},{:.1f} ", wavelengths().at(kFirstNm + static_cast<double>(i)),
                              y.at(samples[i]));
    return fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", points, style);
}

std::string light_panel(const CollapsePlan& plan) {
    std::string out = wavelength_grid(kLightTop, kLightTop + kLightHeight);
    if (!plan.illuminant)
        return out + text_at(kLeft, kLightTop - 8, "no light: the bands are radiance");
    const NmSamples& power = plan.illuminant->power;
    const double most = *std::max_element(power.begin(), power.end());
    const PlotAxis y(0, most, kLightTop + kLightHeight, kLightTop);
    out += text_at(kLeft, kLightTop - 8,
                   "light: relative power of " + plan.illuminant->id +
                       (plan.filters.empty() ? ""
                                             : "; dashed: behind " + std::to_string(plan.filters.size()) +
                                                   " filter" + (plan.filters.size() == 1 ? "" : "s")));
    out += curve(power, y, "stroke=\"#b8860b\" stroke-width=\"1.5\"");
    if (!plan.filters.empty()) {
        NmSamples behind = power;
        for (const Filter& filter : plan.filters)
            for (std::size_t i = 0; i < behind.size(); ++i)
                behind[i] *= filter.transmittance[i];
        out += curve(behind, y, "stroke=\"#b8860b\" stroke-width=\"1.5\" stroke-dasharray=\"4 3\"");
    }
    return out;
}

/// The bins of a binned basis as boxes, else a line at each wavelength; hollow and grey without weight.
std::string band_panel(const CollapsePlan& plan) {
    const bool bins = is_binned(plan.basis.basis) && plan.basis.basis != Basis::Response;
    std::string out = text_at(kLeft, kBandTop - 6,
                              fmt::format("bands: {} of set {}, {}; {}", plan.bands.size(), plan.request.set,
                                          spacing_text(plan.wavelengths_nm()), bins ? "bins" : "samples"));
    const std::vector<double> edges = bins ? plan.distinct.grid.edges() : std::vector<double>();
    const std::vector<double>& centres = plan.distinct.grid.wavelengths_nm;
    for (std::size_t i = 0; i < plan.bands.size(); ++i) {
        const double nm = plan.bands[i].wavelength_nm;
        const auto place =
            static_cast<std::size_t>(std::lower_bound(centres.begin(), centres.end(), nm) - centres.begin());
        double from = nm - 0.5, to = nm + 0.5;
        if (bins && place + 1 < edges.size()) {
            from = edges[place];
            to = edges[place + 1];
        }
        from = std::clamp(from, kFirstNm, kLastNm);
        to = std::clamp(to, kFirstNm, kLastNm);
        if (from >= to)
            continue;
        out += fmt::format(
            "<rect x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\" {}><title>{:g} nm</title></rect>\n",
            wavelengths().at(from), kBandTop, std::max(1.0, wavelengths().at(to) - wavelengths().at(from)),
            kBandHeight,
            plan.weights.needs(i) ? "fill=\"#9fb8d3\" stroke=\"#2a6fb0\" stroke-width=\"0.5\""
                                  : "fill=\"none\" stroke=\"#aaa\" stroke-width=\"0.5\"",
            nm);
    }
    return out;
}

std::string weight_panel(const CollapsePlan& plan) {
    const std::size_t rows = plan.weights.rows();
    double low = 0, high = 0;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t band = 0; band < plan.bands.size(); ++band) {
            low = std::min(low, plan.weights.at(row, band));
            high = std::max(high, plan.weights.at(row, band));
        }
    const PlotAxis y(low, high, kWeightTop + kWeightHeight, kWeightTop);
    std::string out = wavelength_grid(kWeightTop, kWeightTop + kWeightHeight);
    for (const double value : y.ticks(5))
        out += fmt::format("<line x1=\"{1}\" y1=\"{0:.1f}\" x2=\"{2}\" y2=\"{0:.1f}\" stroke=\"#e4e4e4\"/>\n",
                           y.at(value), kLeft, kWidth - kRight) +
               text_at(kLeft - 8, y.at(value) + 4, fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0 : value),
                       "text-anchor=\"end\" fill=\"#444\"");
    double legend = kLeft;
    out += text_at(legend, kWeightTop - 8, "weights, everything folded in:");
    legend += 190;
    const std::vector<std::string> names = plan.weighed();
    for (std::size_t row = 0; row < rows; ++row) {
        const char* const colour = kOutputColours[row % kOutputColours.size()];
        std::string points, marks;
        for (std::size_t band = 0; band < plan.bands.size(); ++band) {
            const double nm = plan.bands[band].wavelength_nm;
            if (nm < kFirstNm || nm > kLastNm)
                continue;
            const double x = wavelengths().at(nm), weight = plan.weights.at(row, band);
            points += fmt::format("{:.1f},{:.1f} ", x, y.at(weight));
            marks += fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"><title>{} at {:g} nm: {:.9f}</title></circle>\n",
                x, y.at(weight), escaped_xml(names[row]), nm, weight);
        }
        out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\"/>\n<g fill=\"{}\">\n{}</g>\n",
                           points, colour, colour, marks);
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"10\" height=\"10\" fill=\"{}\"/>\n",
                           legend, kWeightTop - 17, colour) +
               text_at(legend + 14, kWeightTop - 8, names[row]);
        legend += 40;
    }
    for (const double nm : wavelengths().ticks(10))
        out += text_at(wavelengths().at(nm), kWeightTop + kWeightHeight + 16, fmt::format("{:g}", nm),
                       "text-anchor=\"middle\" fill=\"#444\"");
    return out + text_at((kLeft + kWidth - kRight) / 2, kWeightTop + kWeightHeight + 34, "wavelength, nm",
                         "text-anchor=\"middle\"");
}

struct Bar {
    std::string name;
    double delta_e;
    const char* colour;
};

std::vector<Bar> budget_bars(const CollapsePlan& plan, const BudgetResult& budget) {
    std::vector<Bar> bars;
    for (const ErrorSource source : kErrorSources)
        bars.push_back({std::string(error_source_name(source)), budget.term(source).delta_e_2000, "#2a6fb0"});
    bars.push_back({"all that is bounded", budget.total.delta_e_2000, "#16406b"});
    for (const BasisSpread& spread : basis_spread(plan))
        bars.push_back({"if " + std::string(basis_name(spread.basis)), spread.residual.max, "#d08a2e"});
    return bars;
}

std::string budget_panel(const image::CollapseJob& job, double& bottom) {
    bottom = kBudgetTop + kBudgetRow;
    std::string out =
        text_at(kLeft, kBudgetTop - 10,
                "budget, CIEDE2000: bounds for greys of 0 to 1 (blue); other bases over the ColorChecker, "
                "not a bound (orange)");
    const auto budget = image::grey_budget(job);
    if (!budget)
        return out + text_at(kLeft, kBudgetTop + 12, "none: " + budget.error().what, "fill=\"#444\"");
    constexpr double kFewest = 1e-8, kMost = 100;
    const PlotAxis x(std::log10(kFewest), std::log10(kMost), kBudgetLeft, kWidth - kRight - 60);
    double y = kBudgetTop;
    for (const Bar& bar : budget_bars(job.plan, *budget)) {
        out += text_at(kBudgetLeft - 8, y + 14, bar.name, "text-anchor=\"end\"");
        const double end = x.at(std::log10(std::clamp(bar.delta_e, kFewest, kMost)));
        out += fmt::format("<rect x=\"{0}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"14\" fill=\"{3}\"/>\n",
                           kBudgetLeft, y + 3, std::max(1.0, end - kBudgetLeft), bar.colour) +
               text_at(end + 6, y + 14, bar.delta_e == 0 ? "0" : fmt::format("{:.2g}", bar.delta_e),
                       "fill=\"#444\"");
        y += kBudgetRow;
    }
    for (double power = std::log10(kFewest); power <= std::log10(kMost); power += 2)
        out += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#aaa\" "
                           "stroke-dasharray=\"2 3\"/>\n",
                           x.at(power), kBudgetTop, y) +
               text_at(x.at(power), y + 16, fmt::format("{:g}", std::pow(10, power)),
                       "text-anchor=\"middle\" fill=\"#444\"");
    bottom = y + 28;
    return out;
}

}  // namespace

std::string plan_plot(const image::CollapseJob& job) {
    const CollapsePlan& plan = job.plan;
    double bottom = 0;
    const std::string budget = budget_panel(job, bottom);
    std::string out =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
                    "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
                    "<rect width=\"{0}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
                    kWidth, bottom);
    out += text_at(kLeft, 28, job.file->path() + " to " + plan.space.id, "font-size=\"15\"");
    out += text_at(kLeft, 48,
                   fmt::format("{}, {} basis, extrapolate {}, plan {}", plan.observer.id,
                               basis_name(plan.basis.basis), extrapolation_name(plan.request.extrapolation),
                               plan.id),
                   "fill=\"#444\"");
    return out + light_panel(plan) + band_panel(plan) + weight_panel(plan) + budget + "</svg>\n";
}

}  // namespace osio::tool
