// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/selection.h>

#include <support/sets.h>

#include <map>

namespace osio::test {
namespace {

std::string error_of(const std::string& key, const std::string& value) {
    CollapseRequest request;
    const auto result = set_option(request, key, value);
    return result ? "no error" : result.error().text();
}

TEST(Request, ARecipeReadsBackAsTheSameRequest) {
    for (const char* text :
         {"to=lin_rec709&illuminant=D65", "to=xyz", "to=ACEScg&white=0.31,0.33&exposure=-1.5&names=rgb",
          "to=xyz_d65&names=xyz&set=left.T&part=beauty&extrapolate=zero&observer=CIE1964&illuminant=FL11",
          "to=luminance&scale=photometric&basis=bins-corrected&filter=a.csv&filter=b.csv,c.csv&filter-"
          "normalise=1",
          "to=xyz&wavelengths=400:10:700&quantity=radiance", "to=raw&wavelengths=bands.csv",
          "to=display&display=panel.csv&illuminant=D(6200)", "to=raw&names=layout", "to=lab&illuminant=A",
          "to=xyY", "to=acescg&illuminant=A&adapt=CAT16",
          "to=rgb:0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329&illuminant=A"}) {
        const std::string once = recipe_text(request_of(text));
        EXPECT_EQ(recipe_text(request_of(once)), once) << text;
    }
    EXPECT_EQ(recipe_text(request_of("to=srgb&illuminant=A")),
              "to=srgb&illuminant=A&observer=cie1931&basis=auto&extrapolate=hold&scale=relative&adapt="
              "bradford&exposure=0");
}

TEST(Request, MistypedWordsAreAnsweredWithTheNearest) {
    EXPECT_EQ(error_of("iluminant", "D65"),
              "no option is called \"iluminant\"; did you mean \"illuminant\"?");
    EXPECT_EQ(error_of("observer", "cie1913"),
              "no observer is called \"cie1913\"; did you mean \"cie1931\"? (a camera's table of "
              "nm,R,G,B is named by its path and ends in .csv)");
    EXPECT_EQ(error_of("extrapolate", "hodl"), "extrapolate \"hodl\" is unknown; did you mean \"hold\"?");
    EXPECT_EQ(error_of("basis", "lineaar"), "no basis is called \"lineaar\"; did you mean \"linear\"?");
    EXPECT_EQ(error_of("names", "rbg"), "names \"rbg\" is unknown; did you mean \"rgb\"?");
    EXPECT_EQ(error_of("adapt", "cat03"), "no adaptation is called \"cat03\"; did you mean \"cat02\"?");
    EXPECT_EQ(error_of("exposure", "bright"),
              "exposure \"bright\" is no number of stops between -100 and 100");
    EXPECT_EQ(error_of("exposure", "1e9"), "exposure \"1e9\" is no number of stops between -100 and 100");
}

TEST(Request, EverySpaceIsKnownByItsIdAndItsAliasesInAnyCase) {
    for (const OutputSpace& space : output_spaces()) {
        EXPECT_EQ(find_output_space(space.id)->id, space.id);
        for (const auto alias : split(space.aliases, '|'))
            if (!alias.empty()) {
                EXPECT_EQ(find_output_space(to_lower(alias))->id, space.id) << alias;
            }
    }
}

TEST(Request, ACustomSpaceIsTheSpaceOfItsChromaticities) {
    const auto custom = find_output_space("RGB: 0.64, 0.33, .3, 0.6, 0.150, 6e-2, 0.3127, 0.3290").value();
    EXPECT_EQ(custom.id, "rgb:0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329");
    EXPECT_EQ(xyz_from_rgb(custom), xyz_from_rgb(find_output_space("lin_rec709").value()));
    EXPECT_EQ(custom.color_space, "");
    for (const auto& [text, why] : std::map<std::string, std::string>{
             {"rgb:0.64,0.33", "has 2 numbers"},
             {"rgb:0.64,0.33,0.3,0.6,0.15,red,0.3127,0.329", "holds \"red\", no chromaticity"},
             {"rgb:64,0.33,0.3,0.6,0.15,0.06,0.3127,0.329", "holds \"64\", no chromaticity"},
             {"rgb:0.64,0.33,0.3,0.6,0.15,0.06,0.3127,0", "has a white that is not above 0"},
             {"rgb:0.1,0.1,0.2,0.2,0.3,0.3,0.3127,0.329", "has primaries on one line"},
             {"rgb:0.7,0.3,0.1,0.3,0.15,0.06,0.4,0.3", "has a white on the line between two primaries"}}) {
        const auto refused = find_output_space(text);
        ASSERT_FALSE(refused) << text;
        EXPECT_EQ(refused.error().code, ErrorCode::Usage);
        EXPECT_NE(refused.error().text().find(why), std::string::npos) << refused.error().text();
    }
}

/// Parts of a file, for the choice of one.
class Parts {
  public:
    Parts& add(const std::string& name, const std::vector<std::string>& channels) {
        m_layouts.push_back(
            std::make_unique<ChannelLayout>(parse_channel_layout(channels, DecimalMark::Comma)));
        m_parts.push_back({name, m_layouts.back().get(), false, std::vector<bool>(channels.size(), false)});
        return *this;
    }

    PartSummary& back() { return m_parts.back(); }

    ChannelLayout& back_layout() { return *m_layouts.back(); }

    std::string choose(const std::string& request) {
        const auto selection = select_set(m_parts, request_of(request));
        if (!selection)
            return selection.error().text();
        const auto& part = m_parts[selection->part];
        return std::to_string(selection->part) + ":" + part.layout->sets[selection->set].name();
    }

    ErrorCode code(const std::string& request) {
        return select_set(m_parts, request_of(request)).error().code;
    }

  private:
    std::vector<std::unique_ptr<ChannelLayout>> m_layouts;
    std::vector<PartSummary> m_parts;
};

TEST(Selection, TheOnlySetNeedsNoName) {
    EXPECT_EQ(Parts().add("", {"R", "T.400nm", "T.500nm"}).choose("to=xyz"), "0:T");
    EXPECT_EQ(Parts().add("beauty", {"R", "G", "B"}).add("bands", {"S0.400nm"}).choose("to=xyz"), "1:S0");
}

TEST(Selection, StokesComponentsStandBackForTheIntensity) {
    Parts polarised;
    polarised.add("", {"S0.400nm", "S1.400nm", "S2.400nm", "S3.400nm"});
    EXPECT_EQ(polarised.choose("to=xyz"), "0:S0");
    EXPECT_EQ(polarised.choose("to=xyz&set=S2"), "0:S2");
    EXPECT_EQ(Parts().add("", {"S1.400nm"}).choose("to=xyz"), "0:S1");
}

TEST(Selection, WhatFitsSeveralIsRefusedWithTheChoices) {
    Parts both;
    both.add("", {"S0.400nm", "T.400nm"});
    EXPECT_EQ(both.choose("to=xyz"), "several sets of bands fit: S0, T; name one with set=... or part=...");
    EXPECT_EQ(both.code("to=xyz"), ErrorCode::Ambiguous);
    EXPECT_EQ(both.choose("to=xyz&set=T"), "0:T");
    Parts eyes;
    eyes.add("left", {"T.400nm"}).add("right", {"T.400nm"});
    EXPECT_EQ(eyes.choose("to=xyz"), "several sets of bands fit: T in part 0 \"left\", T in part 1 "
                                     "\"right\"; name one with set=... or part=...");
    EXPECT_EQ(eyes.choose("to=xyz&part=right"), "1:T");
    EXPECT_EQ(eyes.choose("to=xyz&part=0"), "0:T");
}

TEST(Selection, WhatIsNotThereIsRefusedWithWhatIs) {
    Parts one;
    one.add("beauty", {"R"}).add("bands", {"T.400nm", "left.T.400nm"});
    EXPECT_EQ(one.choose("to=xyz&set=S0"),
              "there is no set \"S0\"; found T in part 1 \"bands\", left.T in part 1 \"bands\"");
    EXPECT_EQ(one.choose("to=xyz&part=2"),
              "there is no part \"2\"; the file has part 0 \"beauty\", part 1 \"bands\"");
    EXPECT_EQ(one.choose("to=xyz&set=left.T"), "1:left.T");
    EXPECT_EQ(one.code("to=xyz&part=0"), ErrorCode::NotSpectral);
}

TEST(Selection, AFileWithoutBandsIsNotSpectralAndNamesItsDialect) {
    Parts plain;
    plain.add("", {"R", "G", "B"});
    EXPECT_EQ(plain.code("to=xyz"), ErrorCode::NotSpectral);
    EXPECT_NE(plain.choose("to=xyz").find("no spectral band among 3 channels (R, G, B)"), std::string::npos);
    Parts numbered;
    numbered.add("", {"0", "1"}).back_layout().dialect = {"OpenCV's numbered channels", "names 0 to 1", {}};
    EXPECT_EQ(numbered.code("to=xyz"), ErrorCode::NotSpectral);
    EXPECT_NE(numbered.choose("to=xyz").find(
                  "OpenCV's numbered channels (names 0 to 1), which say no wavelengths; give them with "
                  "wavelengths=400:10:700"),
              std::string::npos);
}

TEST(Selection, DeepAndSubsampledBandsAreRefused) {
    Parts deep;
    deep.add("", {"T.400nm"}).back().deep = true;
    EXPECT_EQ(deep.code("to=xyz"), ErrorCode::Unsupported);
    Parts subsampled;
    subsampled.add("", {"BY", "T.400nm"}).back().subsampled = {true, false};
    EXPECT_EQ(subsampled.choose("to=xyz"), "0:T");  // only the bands matter
    subsampled.back().subsampled = {false, true};
    EXPECT_EQ(subsampled.code("to=xyz"), ErrorCode::Unsupported);
}

}  // namespace
}  // namespace osio::test
