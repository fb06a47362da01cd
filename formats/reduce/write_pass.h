// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/exr_writer.h>
#include <formats/reduce/sample.h>

#include <array>
#include <cstdint>
#include <vector>

namespace osio::reduce {

/// What a pass over all pixels found.
struct PassResult {
    struct Found {
        double largest = 0;
        double sum = 0;
        std::array<int, 2> largest_at{};  ///< column from 0, row of the data window
        std::uint64_t pixels = 0;         ///< with a difference
        std::uint64_t undefined = 0;
    };

    explicit PassResult(const Subject& subject) : found(subject.demands.size()), beyond(subject.columns()) {}

    std::vector<Found> found;  ///< by demand
    StoredCounts counts;
    SpectrumSample beyond;        ///< of pixels that exceed the tolerance, some of each block
    std::uint64_t unsampled = 0;  ///< pixels that exceed it and hold NaN or infinities in some band

    [[nodiscard]] bool within(double tolerance) const;
};

/// Reads the image once, writes the candidate's samples and compares every pixel as it is stored.
[[nodiscard]] Result<PassResult> write_pass(const Subject& subject, const Candidate& candidate,
                                            double tolerance, exr::ExrWriter& writer, Runner& runner,
                                            const Progress& progress);

}  // namespace osio::reduce
