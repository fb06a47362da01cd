// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>

namespace osio::test {

/// The sample that a plane holds at a column and a row of the data window.
using SampleAt = std::function<float(std::size_t plane, std::size_t x, std::size_t y)>;

/// Reads every block of float planes of a part, last block first, and expects each sample to be as said, NaN for NaN;
/// also that the source knows its blocks' rows, and that planes nobody asked for are not there. The data
/// window starts at row 0. `what` is told with a failure.
inline void expect_samples(const image::SpectralImage& file, const image::PlaneChannels& planes,
                           image::Grain grain, const SampleAt& expected, const std::string& what) {
    const auto source = file.make_block_source(0, planes, grain);
    ASSERT_TRUE(source) << source.error().text();
    const auto reader = (*source)->start_reader().value();
    const auto width = static_cast<std::size_t>((*source)->width());
    int rows = 0;
    for (std::size_t index = (*source)->block_count(); index-- > 0;) {
        const auto block = reader->read(index);
        ASSERT_TRUE(block) << block.error().text();
        const RowRange range = (*source)->rows_of_block(index);
        ASSERT_EQ(block->first_row, range.first);
        ASSERT_EQ(block->row_count, range.last - range.first + 1);
        EXPECT_EQ((*source)->block_of_row(range.first), index);
        EXPECT_EQ((*source)->block_of_row(range.last), index);
        rows += block->row_count;
        for (std::size_t p = 0; p < planes.size(); ++p) {
            ASSERT_EQ(block->planes[p].data != nullptr, planes[p].has_value());
            if (!planes[p])
                continue;
            for (std::size_t y = 0; y < static_cast<std::size_t>(block->row_count); ++y)
                for (std::size_t x = 0; x < width; ++x) {
                    float found = 0;
                    std::memcpy(&found, block->planes[p].data + (y * width + x) * sizeof found, sizeof found);
                    const float wanted = expected(p, x, static_cast<std::size_t>(range.first) + y);
                    ASSERT_TRUE(found == wanted || (std::isnan(found) && std::isnan(wanted)))
                        << what << " at " << x << "," << y << " plane " << p << ": " << found << " for "
                        << wanted;
                }
        }
    }
    EXPECT_EQ(rows, file.parts().front().data_window.height());
}

}  // namespace osio::test
