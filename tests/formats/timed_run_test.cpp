// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/timed_run.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace osio::trade {
namespace {

/// An image's division into blocks, without pixels.
class Blocks final : public BlockSource {
  public:
    Blocks(RowRange rows, int height) : m_rows(rows), m_height(height) {}

    [[nodiscard]] int width() const override { return 1; }

    [[nodiscard]] std::size_t block_count() const override { return block_of_row(m_rows.last) + 1; }

    [[nodiscard]] std::size_t block_of_row(int row) const override {
        return static_cast<std::size_t>((row - m_rows.first) / m_height);
    }

    [[nodiscard]] RowRange rows_of_block(std::size_t block) const override {
        const int first = m_rows.first + static_cast<int>(block) * m_height;
        return {first, std::min(first + m_height - 1, m_rows.last)};
    }

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        return fail(ErrorCode::Io, "no pixels");
    }

  private:
    RowRange m_rows;
    int m_height;
};

TEST(ForecastStrips, AreWholeBlocksApartFromEachOtherAndSpreadOverTheImage) {
    for (const int rows : {1, 7, 100, 1080, 5000})
        for (const int height : {1, 16, 32})
            for (const unsigned workers : {1U, 2U, 9U}) {
                const RowRange all{-3, rows - 4};
                const Blocks source(all, height);
                const std::vector<RowRange> strips = forecast_strips(source, all, workers);
                ASSERT_FALSE(strips.empty());
                if (strips.size() == 1) {
                    EXPECT_EQ(strips[0].first, all.first);
                    EXPECT_EQ(strips[0].last, all.last);
                    continue;
                }
                int run = 0, end = all.first - 1;
                for (const RowRange strip : strips) {
                    EXPECT_GT(strip.first, end);
                    end = strip.last;
                    const std::size_t first = source.block_of_row(strip.first),
                                      last = source.block_of_row(end);
                    EXPECT_EQ(source.rows_of_block(first).first, strip.first);
                    EXPECT_EQ(source.rows_of_block(last).last, end);
                    EXPECT_GE(last - first + 1, 2 * workers);
                    run += end - strip.first + 1;
                }
                EXPECT_LE(end, all.last);
                EXPECT_LT(run, rows);
                EXPECT_LT(strips.front().first, all.first + rows / 4);
                EXPECT_GT(strips.back().last, all.last - rows / 4);
            }
}

TEST(ForecastStrips, ARangeOfRowsKeepsTheStripsInside) {
    const Blocks source({0, 999}, 16);
    const RowRange rows{101, 907};
    for (const RowRange strip : forecast_strips(source, rows, 1)) {
        EXPECT_GE(strip.first, rows.first);
        EXPECT_LE(strip.last, rows.last);
    }
}

}  // namespace
}  // namespace osio::trade
