// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/basis_spread.h>
#include <osio/colour/difference.h>
#include <osio/colour/table_samples.h>
#include <osio/data/tables.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osio {

namespace {

/// The patches at 1 nm; beyond their table they keep their end values.
std::vector<NmSamples> patches() {
    std::vector<NmSamples> out;
    const Table* const table = find_table("reflectances/colorchecker_n_ohta.csv");
    for (const std::string_view name : table->columns)
        out.push_back(sampled_at_1nm_held(*table->column(name)));
    return out;
}

double at(const NmSamples& samples, double nm) {
    const double last = static_cast<double>(kObserverSampleCount - 1);
    const double place = std::clamp(nm - kObserverFirstNm, 0.0, last);
    const auto below = static_cast<std::size_t>(std::min(place, last - 1));
    const double share = place - static_cast<double>(below);
    return (1 - share) * samples[below] + share * samples[below + 1];
}

/// The mean over a bin, by the trapezoidal rule at a tenth of a nanometre or finer.
double mean_over(const NmSamples& samples, double from, double to) {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from) * 10)));
    double sum = 0;
    for (int i = 0; i <= steps; ++i)
        sum += (i == 0 || i == steps ? 0.5 : 1.0) * at(samples, from + (to - from) * i / steps);
    return sum / steps;
}

/// What the bands say of a spectrum if the plan takes them for what they are.
std::vector<double> bands_of(const NmSamples& spectrum, const CollapsePlan& plan) {
    const BandGrid& grid = plan.distinct.grid;
    std::vector<double> out;
    const bool bins = is_binned(plan.basis.basis) && plan.basis.basis != Basis::Response;
    const std::vector<double> edges = bins ? grid.edges() : std::vector<double>();
    for (std::size_t band = 0; band < grid.size(); ++band)
        out.push_back(bins ? mean_over(spectrum, edges[band], edges[band + 1])
                           : at(spectrum, grid.wavelengths_nm[band]));
    return out;
}

/// X, Y and Z of bands with a basis, Y = 1 for the diffuser (of radiance: for flat 1).
class Collapse {
  public:
    Collapse(Basis basis, const CollapsePlan& plan) {
        NmSamples light;
        light.fill(1);
        if (plan.illuminant)
            light = plan.illuminant->power;
        const double k = 1 / integral(light, plan.observer.curves[1], plan.quadrature);
        for (const Filter& filter : plan.filters)
            std::transform(light.begin(), light.end(), filter.transmittance.begin(), light.begin(),
                           std::multiplies<>());
        for (std::size_t c = 0; c < m_weights.size(); ++c) {
            m_weights[c] = band_integrals(basis, plan.distinct.grid, light, plan.observer.curves[c],
                                          plan.request.extrapolation, plan.quadrature);
            for (double& weight : m_weights[c])
                weight *= k;
        }
    }

    /// False where the bands' responses allow no such basis.
    [[nodiscard]] bool possible() const { return !m_weights[0].empty(); }

    [[nodiscard]] Vector3 xyz(const std::vector<double>& bands) const {
        Vector3 out{};
        for (std::size_t c = 0; c < out.size(); ++c)
            for (std::size_t band = 0; band < bands.size(); ++band)
                out[c] += m_weights[c][band] * bands[band];
        return out;
    }

  private:
    std::array<std::vector<double>, 3> m_weights;
};

}  // namespace

std::vector<BasisSpread> basis_spread(const CollapsePlan& plan) {
    std::vector<BasisSpread> out;
    if (plan.observer.kind != ObserverKind::Colorimetric || !(plan.white[0] > 0 && plan.white[2] > 0))
        return out;
    std::vector<std::vector<double>> seen;
    for (NmSamples& patch : patches()) {
        if (!plan.illuminant) {
            const NmSamples daylight = find_illuminant("D65")->power;
            for (std::size_t i = 0; i < patch.size(); ++i)
                patch[i] *= daylight[i] / at(daylight, 560);
        }
        seen.push_back(bands_of(patch, plan));
    }
    const Collapse own(plan.basis.basis, plan);
    for (const BasisInfo& info : bases()) {
        if (info.basis == plan.basis.basis || !basis_fits(info.basis, plan.distinct.grid))
            continue;
        const Collapse other(info.basis, plan);
        if (!other.possible())
            continue;
        BasisSpread spread{info.basis, 0, 0};
        for (const std::vector<double>& bands : seen) {
            const double delta =
                delta_e_2000(lab_of(own.xyz(bands), plan.white), lab_of(other.xyz(bands), plan.white));
            spread.mean += delta / static_cast<double>(seen.size());
            spread.max = std::max(spread.max, delta);
        }
        out.push_back(spread);
    }
    return out;
}

}  // namespace osio
