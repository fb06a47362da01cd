// SPDX-License-Identifier: Apache-2.0
#include <osio/base/value_statistics.h>

#include <support/bound.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace osio::test {
namespace {

TEST(ValueStatistics, AgreesWithSortedValues) {
    std::mt19937 random(8);
    std::normal_distribution<double> value(1, 3);
    Bound bound("percentile against sorted values, relative", 1.0 / 4096 + 1e-7);
    for (const std::size_t count : {1U, 2U, 7U, 100U, 20001U}) {
        ValueStatistics statistics;
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) {
            values.push_back(std::pow(value(random), 3));
            statistics.add(values.back());
        }
        std::sort(values.begin(), values.end());
        EXPECT_EQ(statistics.count(), count);
        EXPECT_EQ(statistics.minimum(), values.front());
        EXPECT_EQ(statistics.maximum(), values.back());
        for (const double percent : {0.0, 1.0, 5.0, 50.0, 95.0, 99.0, 100.0}) {
            const auto rank = static_cast<std::size_t>(
                std::max(1.0, std::ceil(percent / 100 * static_cast<double>(count))));
            bound.see_relative(statistics.percentile(percent), values[rank - 1], std::to_string(percent));
        }
    }
}

TEST(ValueStatistics, ZeroIsItsOwnPercentile) {
    ValueStatistics statistics;
    for (const double value : {-1.0, 0.0, 0.0, 0.0, 1.0})
        statistics.add(value);
    EXPECT_EQ(statistics.percentile(50), 0);
}

TEST(ValueStatistics, UndefinedValuesAreCountedApart) {
    ValueStatistics statistics;
    EXPECT_EQ(statistics.mean(), 0);
    EXPECT_EQ(statistics.percentile(50), 0);
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), 2.0, 4.0})
        statistics.add(value);
    EXPECT_EQ(statistics.undefined_count(), 2U);
    EXPECT_EQ(statistics.count(), 2U);
    EXPECT_EQ(statistics.mean(), 3);
    EXPECT_EQ(statistics.maximum(), 4);
}

}  // namespace
}  // namespace osio::test
