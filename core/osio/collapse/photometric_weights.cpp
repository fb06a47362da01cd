// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/photometric_weights.h>
#include <osio/colour/photometric_constants.h>
#include <osio/colour/photometry.h>

#include <array>
#include <cmath>

namespace osio {

WeightMatrix photometric_weights(const CollapsePlan& plan) {
    NmSamples ones{};
    ones.fill(1.0);
    const double gain = std::exp2(plan.request.exposure_stops);
    const std::array<std::pair<double, const NmSamples*>, 3> rows{
        {{gain * kLuminousEfficacyLmPerW, &photopic_efficiency()},
         {gain * kScotopicEfficacyLmPerW, &scotopic_efficiency()},
         {gain, &ones}}};
    const DistinctBands& distinct = plan.distinct;
    WeightMatrix out(rows.size(), plan.bands.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const auto [scale, curve] = rows[row];
        const auto integrals = band_integrals(plan.basis.basis, distinct.grid, ones, *curve,
                                              plan.request.extrapolation, plan.quadrature);
        for (std::size_t band = 0; band < plan.bands.size(); ++band)
            out.at(row, band) = scale * integrals[distinct.index_of_band[band]] * distinct.share_of(band);
    }
    return out;
}

}  // namespace osio
