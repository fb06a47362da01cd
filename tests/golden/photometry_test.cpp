// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/photometric_weights.h>
#include <osio/colour/photometric_constants.h>
#include <osio/colour/photometry.h>

#include <support/bound.h>
#include <support/csv.h>
#include <support/sets.h>

namespace osio::test {
namespace {

/// The spectrum of a golden row: a light scaled to 1 at 560 nm, or flat 1.
NmSamples power_of(const Csv::Row& row) {
    const std::string name = row.at("spectrum").substr(0, row.at("spectrum").find(' '));
    NmSamples power = find_illuminant(name == "flat" ? "E" : name).value().power;
    const double at_560 = power[560 - kObserverFirstNm];
    for (double& p : power)
        p /= at_560;
    return power;
}

TEST(GoldenPhotometry, LuminanceEfficacyScotopicAndRatio) {
    Bound bound("G10 relative error of photometry", 1e-12);
    for (const auto& row : Csv(golden("luminance.csv")).rows) {
        const LightPhotometry found = photometry_of(power_of(row));
        const std::string& where = row.at("spectrum");
        bound.see_relative(found.luminous, number(row, "Y_683_sum1nm_cd_m2"), where);
        bound.see_relative(found.radiant, number(row, "radiance_W_sr_m2(sum 1nm)"), where);
        bound.see_relative(found.efficacy(), number(row, "LER_lm_per_W"), where);
        bound.see_relative(found.scotopic, number(row, "scotopic_1700"), where);
        bound.see_relative(found.sp_ratio(), number(row, "S_over_P"), where);
        bound.see_relative(found.luminous * kLargestPhotopicEfficacyLmPerW / kLuminousEfficacyLmPerW,
                           number(row, "Y_683.002"), where);
    }
}

TEST(GoldenPhotometry, WeightsOfBandsAtOneNanometre) {
    const auto plan = plan_of(set_of(Family::S0, steps(360, 1, 830)), "to=xyz").value();
    const WeightMatrix weights = photometric_weights(plan);
    Bound bound("relative error of weights", 1e-12);
    for (const auto& row : Csv(golden("luminance.csv")).rows) {
        const NmSamples power = power_of(row);
        Vector3 out{};
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t band = 0; band < power.size(); ++band)
                out[r] += weights.at(r, band) * power[band];
        bound.see_relative(out[0], number(row, "Y_683_sum1nm_cd_m2"), row.at("spectrum"));
        bound.see_relative(out[1], number(row, "scotopic_1700"), row.at("spectrum"));
        bound.see_relative(out[2], number(row, "radiance_W_sr_m2(sum 1nm)"), row.at("spectrum"));
    }
}

TEST(GoldenPhotometry, LuminanceIsTheYOfAPlanTimesThatOfFlatOne) {
    Bound bound("luminance weights against Y", 1e-12);
    for (const auto& grid :
         {steps(400, 10, 700), {400.0, 500.0, 500.0, 650.0}, steps(500, 0.25, 520), {555.0}}) {
        for (const char* request :
             {"to=xyz", "to=xyz&exposure=2", "to=xyz&basis=linear", "to=xyz&basis=bins"}) {
            const auto plan = plan_of(set_of(Family::S0, grid), request).value();
            NmSamples ones{};
            ones.fill(1);
            const double flat =
                kLuminousEfficacyLmPerW * integral(ones, photopic_efficiency(), plan.quadrature);
            const WeightMatrix weights = photometric_weights(plan);
            for (std::size_t band = 0; band < plan.bands.size(); ++band)
                bound.see_absolute(weights.at(0, band) / flat, plan.weights.at(1, band), request);
        }
    }
}

}  // namespace
}  // namespace osio::test
