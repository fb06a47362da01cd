// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/kernel.h>
#include <osio/collapse/plan.h>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace osio::test {

/// What both executors make of a pixel whose samples follow the set's channels, with `neighbour` in all
/// samples of the pixels beside it. Fails the test where the executors differ in a bit, or where a
/// neighbour depends on the pixel.
inline std::vector<float> executed(const CollapsePlan& plan, const std::vector<float>& samples,
                                   float neighbour = 1) {
    constexpr std::size_t kPixels = 37, kAt = 18;
    std::vector<std::vector<float>> planes;
    std::vector<BandView> views;
    for (const PlanColumn& column : plan.columns) {
        auto& plane = planes.emplace_back(kPixels, neighbour);
        plane[kAt] = samples.at(column.channel);
    }
    for (const auto& plane : planes)
        views.push_back({reinterpret_cast<const std::byte*>(plane.data()), SampleType::Float, 4});
    using Executor = decltype(&collapse_run);
    std::array<std::vector<std::vector<float>>, 2> results;
    const std::array<Executor, 2> executors{&collapse_run, &collapse_run_reference};
    for (std::size_t e = 0; e < 2; ++e) {
        results[e].assign(plan.weights.rows(), std::vector<float>(kPixels));
        std::vector<float*> out;
        for (auto& row : results[e])
            out.push_back(row.data());
        executors[e](views, plan.weights, kPixels, out);
    }
    std::vector<float> pixel;
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        for (std::size_t i = 0; i < kPixels; ++i) {
            EXPECT_EQ(std::bit_cast<std::uint32_t>(results[0][row][i]),
                      std::bit_cast<std::uint32_t>(results[1][row][i]));
            if (i != kAt) {
                EXPECT_EQ(results[0][row][i], results[0][row][kAt + 1]);
            }
        }
        pixel.push_back(results[0][row][kAt]);
    }
    return pixel;
}

}  // namespace osio::test
