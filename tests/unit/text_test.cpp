// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace osio {
namespace {

TEST(Text, NumbersAreReadWholeOrNotAtAll) {
    EXPECT_EQ(parse_double("1.5"), 1.5);
    EXPECT_EQ(parse_double("+1.5e2"), 150.0);
    EXPECT_EQ(parse_double("-.5"), -0.5);
    for (const char* bad : {"", " 1", "1 ", "1,5", "1.5x", "nan", "inf", "+-1", "1e999", "0x10"})
        EXPECT_FALSE(parse_double(bad)) << bad;
}

TEST(Text, FormattedDoublesReadBackAsTheSameDouble) {
    std::mt19937_64 random(20261123);
    for (int i = 0; i < 20000; ++i) {
        const auto value = std::bit_cast<double>(random());
        if (!std::isfinite(value))
            continue;
        const auto back = parse_double(format_double(value));
        ASSERT_TRUE(back) << format_double(value);
        EXPECT_EQ(*back, value);
    }
    EXPECT_EQ(format_double(450), "450");
    EXPECT_EQ(format_double(0.1), "0.1");
    EXPECT_EQ(format_double(-0.5), "-0.5");
}

TEST(Text, OrdinaryMagnitudesHaveNoExponent) {
    for (const double value : {1e-5, 123456.0, 99999999999999.0, 1e14})
        EXPECT_EQ(format_double(value).find('e'), std::string::npos) << format_double(value);
}

TEST(Text, SplitGivesOnePieceMoreThanSeparators) {
    EXPECT_EQ(split("a,,b", ',').size(), 3U);
    EXPECT_EQ(split("", ',').size(), 1U);
    EXPECT_EQ(split("a,", ',')[1], "");
}

TEST(Text, NearestNameIsFoundForTypingErrorsAndNotForGuesses) {
    const std::vector<std::string> names{"lin_rec709", "lin_rec2020", "acescg"};
    EXPECT_EQ(nearest_name("lin_rec790", names), "lin_rec709");
    EXPECT_EQ(nearest_name("ACESCG", names), "acescg");
    EXPECT_FALSE(nearest_name("photograph", names));
    EXPECT_FALSE(nearest_name("x", {}));
}

TEST(Text, SuggestionListsWhatIsKnownWhereNothingIsNear) {
    const std::vector<std::string> names{"hold", "zero"};
    EXPECT_EQ(suggestion("hodl", names), "; did you mean \"hold\"?");
    EXPECT_EQ(suggestion("something", names), "; known are hold, zero");
}

}  // namespace
}  // namespace osio
