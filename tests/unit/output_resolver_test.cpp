// SPDX-License-Identifier: Apache-2.0
//
// Names of output spaces: ours first, then a config's, and answers to names that nobody has.
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/output_resolver.h>
#include <osio/collapse/pixel_stage.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace osio {

namespace {

/// Squares every value, or doubles it.
class Power final : public ColourTransform {
  public:
    explicit Power(bool linear) : m_linear(linear) {}

    void apply(std::span<float* const, 3> planes, std::size_t pixels) const override {
        for (float* const plane : planes)
            for (std::size_t i = 0; i < pixels; ++i)
                plane[i] *= m_linear ? 2 : plane[i];
    }

    [[nodiscard]] bool is_linear() const override { return m_linear; }

    [[nodiscard]] const TransformSource& source() const override { return m_source; }

  private:
    bool m_linear;
    TransformSource m_source;
};

OutputSpace config_space(const std::string& name, bool linear = false) {
    OutputSpace space = find_output_space("aces2065_1").value();
    space.id = "ocio:" + name;
    space.color_space = name;
    space.transform = std::make_shared<Power>(linear);
    return space;
}

class TestConfig final : public ColourConfig {
  public:
    [[nodiscard]] std::string file() const override { return "test.ocio"; }

    [[nodiscard]] std::string name() const override { return "test"; }

    [[nodiscard]] std::vector<ConfigName> names() const override {
        return {{"ACEScg", "scene", {}}, {"Film Log", "scene", {"filmlog"}}};
    }

    [[nodiscard]] Result<OutputSpace> find(std::string_view name) const override {
        if (name == "ACEScg" || name == "Film Log")
            return config_space(std::string(name));
        return fail(ErrorCode::UnknownName, "nothing of that name");
    }
};

Result<std::shared_ptr<const ColourConfig>> test_config(const std::string&) {
    return std::make_shared<TestConfig>();
}

Result<std::shared_ptr<const ColourConfig>> no_config(const std::string&) {
    return std::shared_ptr<const ColourConfig>();
}

/// The id that a name comes to, or the error.
std::string resolved(const std::string& name, const ConfigLoader& load) {
    CollapseRequest request;
    if (const auto set = set_option(request, "to", name); !set)
        return set.error().text();
    if (const auto result = resolve_output(request, load); !result)
        return result.error().text();
    return request.to ? request.to->id : "raw";
}

}  // namespace

TEST(OutputResolver, OursComesFirstUnlessTheConfigIsAskedFor) {
    EXPECT_EQ(resolved("acescg", test_config), "acescg");
    EXPECT_EQ(resolved("ACEScg", test_config), "acescg");
    EXPECT_EQ(resolved("ocio:ACEScg", test_config), "ocio:ACEScg");
    EXPECT_EQ(resolved("OCIO:ACEScg", test_config), "ocio:ACEScg");
    EXPECT_EQ(resolved("Film Log", test_config), "ocio:Film Log");
    EXPECT_EQ(resolved("raw", test_config), "raw");
}

TEST(OutputResolver, AConfigIsOpenedOnlyForNamesThatAreNotOurs) {
    const ConfigLoader forbidden = [](const std::string&) -> Result<std::shared_ptr<const ColourConfig>> {
        ADD_FAILURE();
        return std::shared_ptr<const ColourConfig>();
    };
    EXPECT_EQ(resolved("srgb", forbidden), "srgb");
}

TEST(OutputResolver, UnknownNamesAreAnsweredWithTheNearestOfBoth) {
    EXPECT_EQ(resolved("lin_rec790", no_config),
              "no output space is called \"lin_rec790\"; did you mean \"lin_rec709\"?");
    EXPECT_EQ(
        resolved("lin_rec790", test_config),
        "no output space is called \"lin_rec790\", and nothing in test.ocio; did you mean \"lin_rec709\"?");
    EXPECT_EQ(resolved("film lug", test_config),
              "no output space is called \"film lug\", and nothing in test.ocio; did you mean \"Film Log\"?");
    EXPECT_EQ(
        resolved("ocio:ACEScg", no_config),
        "to=ocio:ACEScg needs a colour config; name one with config=FILE.ocio or in the environment's OCIO");
}

TEST(OutputResolver, TheRecipeReadsBackToTheConfigsSpace) {
    CollapseRequest request;
    ASSERT_TRUE(set_option(request, "to", "ocio:acescg"));
    ASSERT_TRUE(set_option(request, "config", "my.ocio"));
    EXPECT_TRUE(recipe_text(request).starts_with("to=ocio:acescg&config=my.ocio&"));
    ASSERT_TRUE(set_option(request, "to", "acescg"));
    EXPECT_EQ(recipe_text(request).find("config"), std::string::npos);
}

TEST(PixelStage, AConfigsCurveSeesColourWithoutAlphaAndItsMatrixNeedNot) {
    const std::array<float, 3> alpha{0.5F, 0, 1};
    for (const bool linear : {false, true}) {
        std::array<std::vector<float>, 3> planes;
        planes.fill({0.25F, 0.25F, 0.25F});
        const std::array<float*, 3> pointers{planes[0].data(), planes[1].data(), planes[2].data()};
        const PixelStage stage(config_space("x", linear), {});
        ASSERT_TRUE(stage.needed());
        stage.apply(pointers, alpha.data(), alpha.size());
        const std::vector<float> expected =
            linear ? std::vector{0.5F, 0.5F, 0.5F} : std::vector{0.125F, 0.0625F, 0.0625F};
        for (const auto& plane : planes)
            EXPECT_EQ(plane, expected);
    }
}

}  // namespace osio
