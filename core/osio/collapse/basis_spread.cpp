// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/basis_spread.h>
#include <osio/colour/reflectance_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace osio {

namespace {

double at(const NmSamples& samples, double nm) {
    const double last = static_cast<double>(kObserverSampleCount - 1);
    const double place = std::clamp(nm - kObserverFirstNm, 0.0, last);
    const auto below = static_cast<std::size_t>(std::min(place, last - 1));
    const double share = place - static_cast<double>(below);
    return (1 - share) * samples[below] + share * samples[below + 1];
}

/// The mean over a bin: exact, since the samples are joined by straight lines.
double mean_over(const NmSamples& samples, double from, double to) {
    double sum = 0;
    for (double a = from; a < to;) {
        const double b = std::min(to, std::floor(a) + 1);
        sum += (b - a) * at(samples, (a + b) / 2);
        a = b;
    }
    return sum / (to - from);
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
class SpreadWeights {
  public:
    SpreadWeights(Basis basis, const CollapsePlan& plan) {
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

    [[nodiscard]] std::vector<Vector3> colours(const std::vector<std::vector<double>>& pixels) const {
        std::vector<Vector3> out;
        for (const std::vector<double>& bands : pixels) {
            Vector3 xyz{};
            for (std::size_t c = 0; c < xyz.size(); ++c)
                xyz[c] = std::inner_product(bands.begin(), bands.end(), m_weights[c].begin(), 0.0);
            out.push_back(xyz);
        }
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
    std::vector<std::vector<double>> pixels;
    const auto set = find_reflectance_set("colorchecker");
    for (NmSamples spectrum : set->spectra) {
        if (!plan.illuminant) {
            const NmSamples daylight = find_illuminant("D65")->power;
            for (std::size_t i = 0; i < spectrum.size(); ++i)
                spectrum[i] *= daylight[i] / at(daylight, 560);
        }
        pixels.push_back(bands_of(spectrum, plan));
    }
    const auto own = SpreadWeights(plan.basis.basis, plan).colours(pixels);
    for (const BasisInfo& info : bases()) {
        if (info.basis == plan.basis.basis || !basis_fits(info.basis, plan.distinct.grid))
            continue;
        const SpreadWeights other(info.basis, plan);
        if (other.possible())
            out.push_back({info.basis, differences_of(other.colours(pixels), own, plan.white)});
    }
    return out;
}

}  // namespace osio
