// SPDX-License-Identifier: Apache-2.0
#include <osio/layout/channel_name.h>

#include <gtest/gtest.h>

#include <random>

namespace osio {
namespace {

std::optional<ChannelName> comma(std::string_view name) {
    return parse_channel_name(name, DecimalMark::Comma);
}

TEST(ChannelName, BandsOfEveryFamily) {
    EXPECT_EQ(comma("S0.450,000000nm"), (ChannelName{"", Family::S0, 450, {}}));
    EXPECT_EQ(comma("S3.450nm"), (ChannelName{"", Family::S3, 450, {}}));
    EXPECT_EQ(comma("T.400,0nm"), (ChannelName{"", Family::T, 400, {}}));
    EXPECT_EQ(comma("S0.374,688nm"), (ChannelName{"", Family::S0, 374.688, {}}));
}

TEST(ChannelName, ReradiationIsInThenOutAndOnlyOfT) {
    EXPECT_EQ(comma("T.400,0nm.500,5nm"), (ChannelName{"", Family::T, 400, 500.5}));
    EXPECT_FALSE(comma("S0.380,0nm.390,0nm"));
    EXPECT_FALSE(comma("T.400nm.500nm.600nm"));
}

TEST(ChannelName, RootsEndInADot) {
    EXPECT_EQ(comma("left.S0.340nm"), (ChannelName{"left", Family::S0, 340, {}}));
    EXPECT_EQ(comma("a.b.T.550nm.560nm"), (ChannelName{"a.b", Family::T, 550, 560}));
    EXPECT_EQ(comma("S0.T.550nm"), (ChannelName{"S0", Family::T, 550, {}}));
    EXPECT_FALSE(comma("fooT.550nm"));
    EXPECT_FALSE(comma(".T.550nm"));
}

TEST(ChannelName, WhatIsNoBandIsLeftAlone) {
    for (const char* name :
         {"",          "R",        "S0",       "S0.",        "S0.R",  "S3.B",           "T.R",
          "S4.550nm",  "S0.550NM", "s0.550nm", "S0.550.5nm", "S0.nm", "S0550nm",        "T.400",
          "S0.550nm ", "T.400nm.", "T..400nm", "T.0nm",      "Z",     "395.00-405.00nm"})
        EXPECT_FALSE(comma(name)) << name;
}

TEST(ChannelName, NearMissesAreWorthAWord) {
    for (const char* name : {"S0.550.5nm", "T.400", "S0.550NM", "left.T.400", "S0.,nm"})
        EXPECT_TRUE(looks_like_a_band(name)) << name;
    for (const char* name : {"S0.R", "T.R", "R", "S0.550nm", "diffuse.R", "S4.550nm", "T"})
        EXPECT_FALSE(looks_like_a_band(name)) << name;
}

TEST(ChannelName, OurCommaFreeNamesReadBack) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> nm(100, 3000);
    std::uniform_int_distribution<int> family(0, 4), choice(0, 1);
    for (int i = 0; i < 3000; ++i) {
        ChannelName name{choice(random) ? "left.eye" : "",
                         static_cast<Family>(family(random)),
                         choice(random) ? std::floor(nm(random)) : nm(random),
                         {}};
        if (name.family == Family::T && choice(random))
            name.emitted_nm = nm(random);
        for (const auto mark : {DecimalMark::Comma, DecimalMark::Point}) {
            const std::string text = format_channel_name(name, mark);
            EXPECT_EQ(parse_channel_name(text, mark), name) << text;
        }
        EXPECT_EQ(format_channel_name(name, DecimalMark::Point).find(','), std::string::npos);
    }
}

}  // namespace
}  // namespace osio
