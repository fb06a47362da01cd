// SPDX-License-Identifier: Apache-2.0
#include <osio/reduce/demand.h>

#include <utility>

namespace osio {

std::string Demand::name() const {
    return plan.illuminant ? plan.illuminant->id + ", " + plan.observer.id : plan.observer.id;
}

Demand make_demand(CollapsePlan plan, double white_luminance) {
    Demand out;
    out.white = {plan.white[0] * white_luminance, plan.white[1] * white_luminance,
                 plan.white[2] * white_luminance};
    double luminance = 0;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < kObserverSampleCount; ++i)
            out.curves[c][i] = plan.observer.curves[c][i] * (plan.illuminant ? plan.illuminant->power[i] : 1);
    for (const double y : out.curves[1])
        luminance += y;
    for (NmSamples& curve : out.curves)
        for (double& sample : curve)
            sample /= luminance;
    out.plan = std::move(plan);
    return out;
}

}  // namespace osio
