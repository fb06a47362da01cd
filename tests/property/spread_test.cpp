// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/basis_spread.h>
#include <osio/colour/reflectance_set.h>

#include <support/bound.h>
#include <support/sets.h>

#include <cmath>
#include <set>

namespace osio::test {
namespace {

double at(const NmSamples& curve, double nm) {
    const double place = std::clamp(nm - 360, 0.0, 470.0);
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), 469);
    return curve[i] + (place - static_cast<double>(i)) * (curve[i + 1] - curve[i]);
}

/// What a band of `width` nm sees; of no width, its sample.
double band(const NmSamples& curve, double nm, double width) {
    constexpr int kPoints = 4000;
    if (width == 0)
        return at(curve, nm);
    double sum = 0;
    for (int i = 0; i < kPoints; ++i)
        sum += at(curve, nm + width * ((i + 0.5) / kPoints - 0.5));
    return sum / kPoints;
}

/// The spread is what two plans make of the same bands, the slow way: by their weights.
TEST(BasisSpread, IsTheDifferenceBetweenPlans) {
    struct Case {
        Family family;
        std::string light;
        double step, width;
        std::set<std::string> others;
    };

    const std::set<std::string> samples{"linear", "e2022", "bins", "bins-corrected"};
    const std::set<std::string> averages{"linear", "sprague", "e2022", "bins"};
    const ReflectanceSet patches = find_reflectance_set("colorchecker").value();
    Bound bound("spread against two plans, CIEDE2000", 1e-6);
    for (const Case& c : {Case{Family::T, "D65", 10, 0, samples}, Case{Family::T, "FL11", 20, 0, samples},
                          Case{Family::S0, "", 10, 10, averages}, Case{Family::S0, "", 15, 15, averages}}) {
        const auto nm = steps(400, c.step, 700);
        const auto set = set_of(c.family, nm);
        const std::string request = "to=xyz" + (c.light.empty() ? "" : "&illuminant=" + c.light);
        const auto plan = plan_of(set, request).value();
        std::set<std::string> others;
        for (const BasisSpread& spread : basis_spread(plan)) {
            const std::string name(basis_name(spread.basis));
            others.insert(name);
            const auto other = plan_of(set, request + "&basis=" + name).value();
            std::vector<Vector3> found, wanted;
            for (NmSamples curve : patches.spectra) {
                const NmSamples daylight = find_illuminant("D65").value().power;
                for (std::size_t i = 0; c.light.empty() && i < curve.size(); ++i)
                    curve[i] *= daylight[i] / daylight[200];
                std::vector<double> values;
                for (const double l : nm)
                    values.push_back(band(curve, l, c.width));
                const auto a = outputs_of(other, values), b = outputs_of(plan, values);
                found.push_back({a[0], a[1], a[2]});
                wanted.push_back({b[0], b[1], b[2]});
            }
            const DifferenceSummary expected = differences_of(found, wanted, plan.white);
            EXPECT_GT(expected.max, 1e-3) << name;
            bound.see_absolute(spread.residual.mean, expected.mean, request + " " + name);
            bound.see_absolute(spread.residual.max, expected.max, request + " " + name);
        }
        EXPECT_EQ(others, c.others) << request;
    }
}

/// Nothing where there is no colour to differ in, and no basis that the bands cannot have.
TEST(BasisSpread, HasOnlyWhatCanBe) {
    const auto uneven = set_of(Family::T, {400, 450, 510, 600, 700});
    for (const BasisSpread& spread : basis_spread(plan_of(uneven, "to=xyz&illuminant=A").value())) {
        EXPECT_NE(spread.basis, Basis::Sprague);
        EXPECT_NE(spread.basis, Basis::BinsCorrected);
        EXPECT_NE(spread.basis, Basis::Response);
    }
    const auto luminance = plan_of(uneven, "to=luminance&illuminant=A&observer=photopic").value();
    EXPECT_TRUE(basis_spread(luminance).empty());
}

}  // namespace
}  // namespace osio::test
