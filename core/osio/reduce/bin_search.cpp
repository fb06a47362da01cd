// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/difference.h>
#include <osio/reduce/bin_search.h>
#include <osio/reduce/non_negative.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace osio {

namespace {

constexpr std::size_t kEven = 96, kWorst = 48;  // spectra that a descent sees
constexpr int kRounds = 3;                      // of looking for the worst
constexpr double kNarrowestNm = 1;
/// Of what edges of equal importance are equal in, the part that is the same at every nanometre.
constexpr double kEvenShare = 0.3;

}  // namespace

void SpectrumSample::add(std::span<const double> pixel) {
    if (std::all_of(pixel.begin(), pixel.end(), [](double v) { return std::isfinite(v); }))
        m_values.insert(m_values.end(), pixel.begin(), pixel.end());
}

WeightMatrix SpectrumSample::matrix(std::span<const std::size_t> pixels) const {
    WeightMatrix out(m_bands, pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t band = 0; band < m_bands; ++band)
            out.at(band, i) = pixel(pixels[i])[band];
    return out;
}

/// What edges make of some spectra.
class BinSearch::Objective {
  public:
    Objective(const BinSearch& search, double fidelity, const SpectrumSample& sample,
              std::span<const std::size_t> pixels)
        : m_search(search), m_fidelity(fidelity) {
        const WeightMatrix spectra = sample.matrix(pixels);
        m_targets = search.m_fit.targets_of(spectra);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto pixel = sample.pixel(pixels[i]);
            m_non_negative.push_back(*std::min_element(pixel.begin(), pixel.end()) >= 0);
            for (const Demand& demand : search.m_demands) {
                Vector3 xyz{};
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t band = 0; band < pixel.size(); ++band)
                        xyz[c] += demand.plan.weights.at(c, band) * pixel[band];
                m_wanted.push_back(lab_of(xyz, demand.white));
            }
        }
    }

    /// The largest CIEDE2000 of each spectrum.
    [[nodiscard]] std::vector<double> differences(std::span<const double> edges_nm) const {
        Made made(*this, edges_nm);
        std::vector<double> out;
        for (std::size_t i = 0; i < m_non_negative.size(); ++i)
            out.push_back(made.difference(i));
        return out;
    }

    /// The sum of their eighth powers, or what it has come to when it exceeds a limit.
    [[nodiscard]] double cost(std::span<const double> edges_nm, double limit) const {
        Made made(*this, edges_nm);
        double sum = 0;
        for (std::size_t i = 0; i < m_non_negative.size() && sum <= limit; ++i)
            sum += std::pow(made.difference(i), 8);
        return sum;
    }

  private:
    /// The samples that edges give.
    class Made {
      public:
        Made(const Objective& objective, std::span<const double> edges_nm)
            : m_objective(objective), m_weights(objective.m_search.m_fit.weights(edges_nm)),
              m_samples(objective.m_search.m_fit.fit(edges_nm, m_weights, objective.m_fidelity,
                                                     objective.m_targets)),
              m_metric(objective.m_search.m_fit.metric(m_weights, objective.m_fidelity)), m_project(m_metric),
              m_pixel(m_samples.rows()) {}

        Made(const Made&) = delete;
        Made& operator=(const Made&) = delete;

        [[nodiscard]] double difference(std::size_t i) {
            const auto& demands = m_objective.m_search.m_demands;
            for (std::size_t bin = 0; bin < m_pixel.size(); ++bin)
                m_pixel[bin] = m_samples.at(bin, i);
            if (m_objective.m_non_negative[i])
                m_project.project(m_pixel);
            double out = 0;
            for (std::size_t d = 0; d < demands.size(); ++d) {
                Vector3 xyz{};
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t bin = 0; bin < m_pixel.size(); ++bin)
                        xyz[c] += m_weights.at(3 * d + c, bin) * m_pixel[bin];
                out = std::max(out, delta_e_2000(m_objective.m_wanted[i * demands.size() + d],
                                                 lab_of(xyz, demands[d].white)));
            }
            return out;
        }

      private:
        const Objective& m_objective;
        WeightMatrix m_weights, m_samples, m_metric;
        NonNegative m_project;
        std::vector<double> m_pixel;
    };

    const BinSearch& m_search;
    double m_fidelity;
    FitTargets m_targets;
    std::vector<bool> m_non_negative;
    std::vector<Lab> m_wanted;  ///< by spectrum, then demand
};

namespace {

/// Edges between which the demands ask for the same, on whole nanometres inside.
std::vector<double> even_edges(const BinFit& fit, std::size_t count) {
    const double first = fit.first_nm(), last = fit.last_nm();
    const NmSamples& importance = fit.importance();
    const double mean = std::accumulate(importance.begin(), importance.end(), 0.0) / kObserverSampleCount;
    std::vector<double> running{0};
    const auto low = static_cast<int>(std::ceil(first)), high = static_cast<int>(std::floor(last));
    for (int nm = low; nm < high; ++nm)
        running.push_back(running.back() + kEvenShare * mean +
                          (1 - kEvenShare) * importance[static_cast<std::size_t>(nm - kObserverFirstNm)]);
    std::vector<double> out{first};
    for (std::size_t i = 1; i < count; ++i) {
        const double wanted = running.back() * static_cast<double>(i) / static_cast<double>(count);
        const auto at = std::lower_bound(running.begin(), running.end(), wanted) - running.begin();
        const auto left = static_cast<double>(count - i);
        out.push_back(std::clamp(low + static_cast<double>(at), std::ceil(out.back() + kNarrowestNm),
                                 std::floor(last - left * kNarrowestNm)));
    }
    out.push_back(last);
    return out;
}

/// A gain that is too small to matter would only keep a descent going.
constexpr double kGain = 0.98;

template <class Objective>
void descend(const Objective& objective, std::vector<double>& edges) {
    double best = objective.cost(edges, std::numeric_limits<double>::infinity());
    for (const double step : {32.0, 16.0, 8.0, 4.0, 2.0, 1.0})
        for (bool moved = true; moved;) {
            moved = false;
            for (std::size_t i = 1; i + 1 < edges.size(); ++i)
                for (const double by : {step, -step}) {
                    const double before = edges[i];
                    const double after = before + by;
                    if (after - edges[i - 1] < kNarrowestNm || edges[i + 1] - after < kNarrowestNm)
                        continue;
                    edges[i] = after;
                    if (const double now = objective.cost(edges, kGain * best); now < kGain * best) {
                        best = now;
                        moved = true;
                    } else {
                        edges[i] = before;
                    }
                }
        }
}

}  // namespace

std::vector<double> BinSearch::place(std::size_t count, double fidelity, const SpectrumSample& sample) const {
    std::vector<double> edges = even_edges(m_fit, count);
    if (count < 2 || sample.size() == 0)
        return edges;
    std::vector<std::size_t> all(sample.size()), seen;
    std::iota(all.begin(), all.end(), std::size_t{0});
    const Objective whole(*this, fidelity, sample, all);
    for (std::size_t i = 0; i < std::min(kEven, all.size()); ++i)
        seen.push_back(i * all.size() / std::min(kEven, all.size()));
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<double> differences = whole.differences(edges);
        std::vector<std::size_t> order = all;
        const std::size_t worst = std::min(kWorst, order.size());
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(worst), order.end(),
                          [&](std::size_t a, std::size_t b) {
                              return differences[a] != differences[b] ? differences[a] > differences[b]
                                                                      : a < b;
                          });
        for (std::size_t i = 0; i < worst; ++i)
            if (std::find(seen.begin(), seen.end(), order[i]) == seen.end())
                seen.push_back(order[i]);
        // The worst first: a move that is none is known sooner.
        std::sort(seen.begin(), seen.end(), [&](std::size_t a, std::size_t b) {
            return differences[a] != differences[b] ? differences[a] > differences[b] : a < b;
        });
        descend(Objective(*this, fidelity, sample, seen), edges);
    }
    return edges;
}

}  // namespace osio
