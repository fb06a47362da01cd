// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/observer.h>
#include <osio/colour/photometric_constants.h>
#include <osio/colour/photometry.h>
#include <osio/data/tables.h>

#include <numeric>

namespace osio {

const NmSamples& photopic_efficiency() {
    static const NmSamples kV = find_observer("cie1931").value().curves[1];
    return kV;
}

const NmSamples& scotopic_efficiency() {
    static const NmSamples kV = [] {
        const Spectrum curve = find_table("observers/scotopic.csv")->column("V").value();
        NmSamples out{};
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = curve.linear_at(kObserverFirstNm + static_cast<double>(i));
        return out;
    }();
    return kV;
}

LightPhotometry photometry_of(const NmSamples& power) {
    return {std::accumulate(power.begin(), power.end(), 0.0),
            kLuminousEfficacyLmPerW * integral(power, photopic_efficiency(), Quadrature::Sum1nm),
            kScotopicEfficacyLmPerW * integral(power, scotopic_efficiency(), Quadrature::Sum1nm)};
}

}  // namespace osio
