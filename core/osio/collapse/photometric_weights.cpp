// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/photometric_weights.h>
#include <osio/colour/photometric_constants.h>
#include <osio/colour/photometry.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osio {

WeightMatrix photometric_weights(const CollapsePlan& plan) {
    const std::vector<double> all_nm = plan.wavelengths_nm();
    std::vector<double> nm = all_nm;
    nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
    NmSamples ones{};
    ones.fill(1.0);
    const double gain = std::exp2(plan.request.exposure_stops);
    const std::array<std::pair<double, const NmSamples*>, 3> rows{
        {{gain * kLuminousEfficacyLmPerW, &photopic_efficiency()},
         {gain * kScotopicEfficacyLmPerW, &scotopic_efficiency()},
         {gain, &ones}}};
    WeightMatrix out(rows.size(), all_nm.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const auto [scale, curve] = rows[row];
        const auto integrals =
            linear_basis_integrals(nm, ones, *curve, plan.request.extrapolation, plan.quadrature);
        for (std::size_t band = 0; band < all_nm.size(); ++band) {
            const auto at = std::lower_bound(nm.begin(), nm.end(), all_nm[band]) - nm.begin();
            const auto sharing = std::count(all_nm.begin(), all_nm.end(), all_nm[band]);
            out.at(row, band) =
                scale * integrals[static_cast<std::size_t>(at)] / static_cast<double>(sharing);
        }
    }
    return out;
}

}  // namespace osio
