// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/adaptation.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/rgb_space.h>

#include <support/bound.h>
#include <support/sets.h>

#include <array>

namespace osio::test {
namespace {

constexpr std::array kAll{Adaptation::None,     Adaptation::XyzScaling, Adaptation::VonKries,
                          Adaptation::Bradford, Adaptation::Cat02,      Adaptation::Cat16};

Vector3 white_of(const std::string& light) {
    return white_point(find_illuminant(light).value(), find_observer("cie1931").value()).value();
}

TEST(Adaptation, CarriesTheWhiteToTheWhite) {
    Bound bound("white after adaptation", 1e-14);
    for (const Adaptation adaptation : kAll)
        for (const std::string& light : illuminant_names()) {
            if (adaptation == Adaptation::None)
                continue;
            const Vector3 from = white_of(light), to = kD65.xyz();
            const Vector3 out = adaptation_matrix(adaptation, from, to).value() * from;
            for (std::size_t c = 0; c < 3; ++c)
                bound.see_absolute(out[c], to[c], light + std::string(adaptation_name(adaptation)));
        }
}

TEST(Adaptation, ThereAndBackIsNothing) {
    Bound bound("adaptation and its way back", 1e-13);
    for (const Adaptation adaptation : kAll)
        for (const char* light : {"A", "D50", "FL11", "HP1"}) {
            const Matrix3 both = adaptation_matrix(adaptation, kD65.xyz(), white_of(light)).value() *
                                 adaptation_matrix(adaptation, white_of(light), kD65.xyz()).value();
            for (std::size_t r = 0; r < 3; ++r)
                for (std::size_t c = 0; c < 3; ++c)
                    bound.see_absolute(both.rows[r][c], r == c ? 1 : 0, light);
        }
}

TEST(Adaptation, EqualWhitesAndNoneAreTheIdentityExactly) {
    for (const Adaptation adaptation : kAll)
        EXPECT_EQ(adaptation_matrix(adaptation, white_of("A"), white_of("A")).value(), Matrix3::identity());
    EXPECT_EQ(adaptation_matrix(Adaptation::None, white_of("A"), kD65.xyz()).value(), Matrix3::identity());
    EXPECT_EQ(adaptation_matrix(Adaptation::XyzScaling, {2, 1, 4}, {1, 1, 1}).value(),
              Matrix3::diagonal({0.5, 1, 0.25}));
}

TEST(Adaptation, GreyStaysGreyUnderEqualEnergy) {
    // Rows of CAT02 and CAT16 sum to 1, so that equal energy gives equal responses; of the older
    // matrices von Kries does so for D65 instead. A digit mistyped in a row breaks the sum.
    for (const Adaptation adaptation : {Adaptation::Bradford, Adaptation::Cat02, Adaptation::Cat16})
        for (const double response : response_matrix(adaptation) * Vector3{1, 1, 1})
            EXPECT_NEAR(response, 1, 1.1e-4) << adaptation_name(adaptation);
    for (const double response : response_matrix(Adaptation::VonKries) * kD65.xyz())
        EXPECT_NEAR(response, 1, 1e-4);
}

TEST(Adaptation, AWhiteWithoutAResponseIsRefused) {
    const auto refused = adaptation_matrix(Adaptation::XyzScaling, {2.5, 1, 0}, kD65.xyz());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidGrid);
    EXPECT_NE(refused.error().text().find("adapt=xyz-scaling"), std::string::npos);
}

TEST(Adaptation, NamesReadBack) {
    for (const Adaptation adaptation : kAll)
        EXPECT_EQ(find_adaptation(to_lower(adaptation_name(adaptation))).value(), adaptation);
}

TEST(Adaptation, APlanFoldsItIn) {
    const auto set = set_of(Family::T, steps(400, 10, 700));
    const auto xyz = plan_of(set, "to=xyz&illuminant=A").value();
    Bound bound("weights against the adapted weights of xyz", 1e-14);
    for (const Adaptation adaptation : kAll) {
        const std::string name(adaptation_name(adaptation));
        const auto plan = plan_of(set, "to=xyz_d65&illuminant=A&adapt=" + name).value();
        const Matrix3 matrix = adaptation_matrix(adaptation, white_of("A"), kD65.xyz()).value();
        for (std::size_t band = 0; band < plan.bands.size(); ++band) {
            const Vector3 expected =
                matrix * Vector3{xyz.weights.at(0, band), xyz.weights.at(1, band), xyz.weights.at(2, band)};
            for (std::size_t row = 0; row < 3; ++row)
                bound.see_absolute(plan.weights.at(row, band), expected[row], name);
        }
    }
    EXPECT_FALSE(plan_of(set, "to=xyz&illuminant=A&adapt=cat02"));
}

}  // namespace
}  // namespace osio::test
