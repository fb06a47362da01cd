// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/difference.h>
#include <osio/reduce/bin_search.h>

#include <algorithm>
#include <cmath>
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
        const auto& demands = m_search.m_demands;
        const WeightMatrix weights = m_search.m_fit.weights(edges_nm);
        WeightMatrix samples = m_search.m_fit.fit(edges_nm, weights, m_fidelity, m_targets);
        std::vector<double> out(samples.bands());
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (m_non_negative[i])
                for (std::size_t bin = 0; bin < samples.rows(); ++bin)
                    samples.at(bin, i) = std::max(samples.at(bin, i), 0.0);
            for (std::size_t d = 0; d < demands.size(); ++d) {
                Vector3 xyz{};
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t bin = 0; bin < samples.rows(); ++bin)
                        xyz[c] += weights.at(3 * d + c, bin) * samples.at(bin, i);
                out[i] = std::max(
                    out[i], delta_e_2000(m_wanted[i * demands.size() + d], lab_of(xyz, demands[d].white)));
            }
        }
        return out;
    }

    [[nodiscard]] double operator()(std::span<const double> edges_nm) const {
        double sum = 0;
        for (const double delta : differences(edges_nm))
            sum += std::pow(delta, 8);
        return sum;
    }

  private:
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

template <class Cost>
void descend(const Cost& cost, std::vector<double>& edges) {
    double best = cost(edges);
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
                    // A gain that is too small to matter would only keep the descent going.
                    if (const double now = cost(edges); now < 0.98 * best) {
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
        descend(Objective(*this, fidelity, sample, seen), edges);
    }
    return edges;
}

}  // namespace osio
