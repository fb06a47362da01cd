// SPDX-License-Identifier: Apache-2.0
//
// Polarimetric spaces: weights of Stokes components, and degrees and angles of light that was made of them.
#include <osio/collapse/pixel_stage.h>
#include <osio/collapse/polarisation_stage.h>
#include <osio/collapse/selection.h>
#include <osio/colour/polarisation.h>

#include <support/bound.h>
#include <support/sets.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace osio::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kComponents{Family::S0, Family::S1, Family::S2, Family::S3};

ChannelLayout layout_of(const std::vector<Family>& families, const std::vector<double>& nm,
                        const std::string& root = {}) {
    std::vector<std::string> names;
    for (const Family family : families)
        for (const double band : nm)
            names.push_back(format_channel_name({root, family, band, {}}, DecimalMark::Comma));
    return parse_channel_layout(names, DecimalMark::Comma);
}

Result<CollapsePlan> stokes_plan(const ChannelLayout& layout, const std::string& request,
                                 const SpectralMetadata& metadata = {}) {
    const CollapseRequest words = request_of(request);
    const std::vector<PartSummary> parts{
        {"", &layout, false, std::vector<bool>(layout.channel_names.size())}};
    OSIO_TRY(const Selection chosen, select_set(parts, words));
    return make_plan(layout.sets, chosen.set, metadata, words, no_files);
}

TEST(Polarisation, OfLightMadeWithAGivenEllipse) {
    // A share p of the light on an ellipse with azimuth psi and ellipticity chi: S = I (1, p cos 2psi cos 2chi,
    // p sin 2psi cos 2chi, p sin 2chi).
    Bound bound("degrees and angles", 1e-12);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.01, 1), angle(-89.9, 90), ellipticity(-44, 44);
    for (int i = 0; i < 2000; ++i) {
        const double p = share(random), psi = angle(random), chi = ellipticity(random),
                     intensity = 100 * share(random);
        const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
        const StokesVector s{intensity,
                             intensity * p * std::cos(radians(2 * psi)) * std::cos(radians(2 * chi)),
                             intensity * p * std::sin(radians(2 * psi)) * std::cos(radians(2 * chi)),
                             intensity * p * std::sin(radians(2 * chi))};
        bound.see_absolute(polarisation_of(SpaceKind::DoP, s).value, p, "DoP");
        bound.see_absolute(polarisation_of(SpaceKind::DoLP, s).value, p * std::cos(radians(2 * chi)), "DoLP");
        bound.see_absolute(polarisation_of(SpaceKind::DoCP, s).value,
                           p * std::abs(std::sin(radians(2 * chi))), "DoCP");
        bound.see_absolute(polarisation_of(SpaceKind::AoLP, s).value / 90, psi / 90, "AoLP");
    }
}

TEST(Polarisation, CardinalDirectionsAreExact) {
    const auto angle = [](double s1, double s2) {
        return polarisation_of(SpaceKind::AoLP, {1, s1, s2, 0}).value;
    };
    EXPECT_EQ(angle(1, 0), 0);
    EXPECT_EQ(angle(0, 1), 45);
    EXPECT_EQ(angle(0, -1), -45);
    EXPECT_EQ(angle(-1, 0), 90);
    EXPECT_EQ(angle(-1, -0.0), 90);  // -90 and 90 are one direction
    EXPECT_EQ(angle(1, -0.0), 0);
}

TEST(Polarisation, WhatHasNoneIsZeroAndSaidAndWhatCannotBeIsNaN) {
    for (const SpaceKind kind : {SpaceKind::DoP, SpaceKind::DoLP, SpaceKind::DoCP}) {
        EXPECT_EQ(polarisation_of(kind, {}).value, 0);
        EXPECT_TRUE(polarisation_of(kind, {}).undefined);
        EXPECT_EQ(polarisation_of(kind, {2, 0, 0, 0}).value, 0);
        EXPECT_FALSE(polarisation_of(kind, {2, 0, 0, 0}).undefined);
        EXPECT_TRUE(std::isnan(polarisation_of(kind, {0, 1, 1, 1}).value));
        EXPECT_TRUE(std::isnan(polarisation_of(kind, {-1, 1, 1, 1}).value));
        EXPECT_TRUE(std::isnan(polarisation_of(kind, {-1, 0, 0, 0}).value));
        EXPECT_TRUE(std::isnan(polarisation_of(kind, {kNan, 1, 1, 1}).value));
        EXPECT_TRUE(std::isnan(polarisation_of(kind, {0, kNan, kNan, kNan}).value));
        EXPECT_GT(polarisation_of(kind, {1, 2, 2, 2}).value, 1);
    }
    EXPECT_TRUE(polarisation_of(SpaceKind::AoLP, {5, 0, 0, 3}).undefined);
    EXPECT_EQ(polarisation_of(SpaceKind::AoLP, {5, 0, 0, 3}).value, 0);
    EXPECT_TRUE(std::isnan(polarisation_of(SpaceKind::AoLP, {5, kNan, 1, 3}).value));
}

TEST(Polarisation, StageIsItsFormulaWithAlphaAsItWas) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> value(-1, 1);
    const std::vector<float> alpha{1, 0.5F, 0.25F, 0, -1, 1, 1};
    for (const SpaceKind kind : {SpaceKind::DoP, SpaceKind::DoLP, SpaceKind::DoCP, SpaceKind::AoLP})
        for (const bool with_alpha : {false, true}) {
            const auto index = stokes_components(kind);
            std::vector<std::vector<float>> planes(index.size(), std::vector<float>(alpha.size()));
            for (std::size_t c = 0; c < index.size(); ++c)
                for (float& sample : planes[c])
                    sample = index[c] == 0 ? std::abs(value(random)) + 0.1F : value(random);
            for (auto& plane : planes)
                plane[5] = 0;  // no light
            for (std::size_t c = 0; c < index.size(); ++c)
                planes[c][6] = index[c] == 0 ? 0.1F : 5.0F;  // more polarised than light can be
            const auto before = planes;
            std::vector<float*> pointers;
            for (auto& plane : planes)
                pointers.push_back(plane.data());
            const auto counts = polarise(kind, pointers, with_alpha ? alpha.data() : nullptr, alpha.size());
            EXPECT_EQ(counts.undefined, 1U);
            std::uint64_t beyond = 0;
            for (std::size_t i = 0; i < alpha.size(); ++i) {
                std::array<double, 4> s{};
                for (std::size_t c = 0; c < index.size(); ++c)
                    s[index[c]] = static_cast<double>(before[c][i]);
                const double expected = polarisation_of(kind, {s[0], s[1], s[2], s[3]}).value;
                beyond += kind != SpaceKind::AoLP && expected > 1.001;
                const double share = with_alpha && alpha[i] > 0 ? static_cast<double>(alpha[i]) : 1;
                EXPECT_EQ(planes[0][i], static_cast<float>(expected * share));
            }
            EXPECT_EQ(counts.beyond, beyond);
        }
}

TEST(StokesPlan, EveryComponentHasTheWeightsOfLuminance) {
    const auto nm = steps(400, 10, 700);
    const auto layout = layout_of({Family::S3, Family::S1, Family::S0, Family::S2}, nm);
    for (const char* more : {"", "&exposure=2", "&scale=photometric", "&observer=cie1964",
                             "&observer=scotopic", "&basis=linear&extrapolate=zero"}) {
        const auto y = plan_of(set_of(Family::S0, nm), std::string("to=luminance") + more).value();
        for (const char* to : {"s0", "s1", "s2", "s3", "dop", "dolp", "docp", "aolp"}) {
            const auto plan = stokes_plan(layout, "to=" + std::string(to) + more).value();
            const auto index = stokes_components(plan.space.kind);
            ASSERT_EQ(plan.weights.rows(), index.size());
            ASSERT_EQ(plan.columns.size(), index.size() * nm.size());
            EXPECT_EQ(plan.outputs.size(), 1U);
            EXPECT_EQ(plan.weighed().size(), index.size());
            EXPECT_EQ(plan.extrapolated_share.size(), index.size());
            for (std::size_t row = 0; row < index.size(); ++row)
                for (std::size_t column = 0; column < plan.columns.size(); ++column) {
                    const bool own = column / nm.size() == row;
                    EXPECT_EQ(plan.weights.at(row, column), own ? y.weights.at(0, column % nm.size()) : 0);
                    if (own) {
                        EXPECT_TRUE(layout.channel_names[plan.columns[column].channel].starts_with(
                            family_name(kComponents[index[row]])));
                    }
                }
        }
    }
}

TEST(StokesPlan, TheSensitivitiesOfS0AreThoseOfAllItsComponents) {
    const auto layout = layout_of({Family::S0, Family::S1, Family::S2, Family::S3}, {450, 550, 650});
    SpectralMetadata metadata;
    for (const double centre : {450, 550, 650}) {
        const auto channel = *layout.find_channel("S0." + std::to_string(static_cast<int>(centre)) + "nm");
        metadata.sensitivities[channel] = {{centre - 60, centre, centre + 60}, {0, 1, 0}};
    }
    const auto plan = stokes_plan(layout, "to=dolp", metadata).value();
    EXPECT_EQ(plan.basis.basis, Basis::Response);
    for (std::size_t band = 0; band < 3; ++band)
        for (std::size_t row = 1; row < 3; ++row)
            EXPECT_EQ(plan.weights.at(row, 3 * row + band), plan.weights.at(0, band));
}

TEST(StokesPlan, RecipesAndIdsTellPlansApart) {
    const auto layout = layout_of({Family::S0, Family::S1, Family::S2, Family::S3}, steps(400, 20, 700));
    std::vector<std::string> ids;
    for (const char* to : {"s0", "s1", "s2", "s3", "dop", "dolp", "docp", "aolp"}) {
        const auto plan = stokes_plan(layout, std::string("to=") + to).value();
        const auto again = stokes_plan(layout, recipe_text(plan.request)).value();
        EXPECT_EQ(plan.id, again.id) << recipe_text(plan.request);
        EXPECT_EQ(std::count(ids.begin(), ids.end(), plan.id), 0);
        ids.push_back(plan.id);
    }
}

TEST(StokesPlan, OtherWavelengthsHaveWeightsOfTheirOwnAndAWarning) {
    std::vector<std::string> names;
    for (const double nm : steps(400, 10, 700))
        names.push_back(format_channel_name({"", Family::S0, nm, {}}, DecimalMark::Comma));
    for (const double nm : steps(400, 20, 700))
        for (const Family family : {Family::S1, Family::S2})
            names.push_back(format_channel_name({"", family, nm, {}}, DecimalMark::Comma));
    const auto layout = parse_channel_layout(names, DecimalMark::Comma);
    const auto plan = stokes_plan(layout, "to=dolp").value();
    EXPECT_NE(plan.warnings.back().find("S1, S2 are not at the wavelengths of S0"), std::string::npos);
    const auto own = plan_of(set_of(Family::S0, steps(400, 20, 700)), "to=luminance").value();
    for (std::size_t band = 0; band < 16; ++band)
        EXPECT_EQ(plan.weights.at(1, 31 + band), own.weights.at(0, band));
}

TEST(StokesPlan, SaysWhatIsMissing) {
    const auto nm = steps(400, 10, 700);
    const auto error = [](const ChannelLayout& layout, const std::string& request) {
        const auto plan = stokes_plan(layout, request);
        EXPECT_FALSE(plan);
        return plan ? std::string() : plan.error().what;
    };
    const auto two = layout_of({Family::S0, Family::S1}, nm);
    EXPECT_TRUE(stokes_plan(two, "to=s1"));
    EXPECT_EQ(error(two, "to=dolp"), "there is no set S2, which to=dolp is made of; found S0, S1");
    EXPECT_EQ(error(two, "to=dop"), "there is no set S2, S3, which to=dop is made of; found S0, S1");
    EXPECT_TRUE(stokes_plan(layout_of({Family::S1, Family::S2}, nm), "to=aolp"));
    const auto reflectance = layout_of({Family::T}, nm);
    EXPECT_EQ(error(reflectance, "to=dolp"),
              "to=dolp is made of Stokes components, and there is none; found T");
    EXPECT_NE(error(reflectance, "to=dolp&set=T").find("reflectance"), std::string::npos);
    // A reflectance beside the components does not make the request ambiguous.
    EXPECT_TRUE(stokes_plan(layout_of({Family::S0, Family::S1, Family::S2, Family::T}, nm), "to=dolp"));
    EXPECT_NE(error(two, "to=s0&names=rgb").find("one channel, S0"), std::string::npos);
    EXPECT_NE(error(two, "to=s1&names=xyz").find("S1"), std::string::npos);
    EXPECT_NE(error(two, "to=s1&illuminant=D65").find("radiance"), std::string::npos);
    EXPECT_NE(error(two, "to=s1&white=D65").find("not adapted"), std::string::npos);
}

TEST(StokesPlan, RootsAreKeptApart) {
    std::vector<std::string> names;
    for (const char* root : {"left", "right"})
        for (const Family family : {Family::S0, Family::S1, Family::S2})
            for (const double nm : steps(400, 20, 700))
                names.push_back(format_channel_name({root, family, nm, {}}, DecimalMark::Comma));
    const auto layout = parse_channel_layout(names, DecimalMark::Comma);
    const auto both = stokes_plan(layout, "to=dolp");
    ASSERT_FALSE(both);
    EXPECT_NE(both.error().what.find("left.S0, right.S0"), std::string::npos);
    const auto plan = stokes_plan(layout, "to=dolp&set=right.S0").value();
    for (const PlanColumn& column : plan.columns)
        EXPECT_TRUE(layout.channel_names[column.channel].starts_with("right."));
}

TEST(StokesPlan, OfSignedComponentsNothingIsOutsideAGamut) {
    const auto layout = layout_of({Family::S0, Family::S1}, steps(400, 10, 700));
    EXPECT_TRUE(stokes_plan(layout, "to=xyz&set=S1")->has_sign);
    EXPECT_TRUE(stokes_plan(layout, "to=lin_rec709&set=S1")->has_sign);
    EXPECT_FALSE(stokes_plan(layout, "to=xyz&set=S0")->has_sign);
    for (const char* to : {"s1", "s2", "s3", "aolp"})
        EXPECT_FALSE(PixelStage(find_output_space(to).value(), {}).negative_is_outside()) << to;
    EXPECT_TRUE(PixelStage(find_output_space("s0").value(), {}).negative_is_outside());
}

TEST(StokesPlan, AdaptationOfASignedComponentIsTheMatrixOfItsIntensity) {
    const auto layout = layout_of({Family::S0, Family::S1}, steps(400, 10, 700));
    for (const char* to : {"lin_rec709&white=A", "acescg", "xyz_d65&white=FL2", "xyz"}) {
        const auto of = [&](const char* set) {
            return stokes_plan(layout, std::string("to=") + to + "&set=" + set).value().weights;
        };
        const WeightMatrix s0 = of("S0"), s1 = of("S1");
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t band = 0; band < s0.bands(); ++band)
                EXPECT_EQ(s0.at(row, band), s1.at(row, band));
    }
}

}  // namespace
}  // namespace osio::test
