// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/value_statistics.h>
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/weights.h>
#include <osio/colour/rgb_space.h>

#include <array>
#include <cstdint>
#include <limits>

namespace osio {

/// How the planes of an image become XYZ: an inverse curve, then weights of three rows, one column a
/// plane. Bands and RGB are the same to it.
struct XyzRecipe {
    WeightMatrix weights;
    Transfer transfer = Transfer::Linear;
    Vector3 white{};  ///< XYZ that Lab refers to
};

/// One of two images to compare.
struct DifferenceSide {
    const BlockSource& source;
    const XyzRecipe& recipe;
};

/// Pixels beyond these are counted.
struct DifferenceLimits {
    double fail = std::numeric_limits<double>::infinity();
    double warn = std::numeric_limits<double>::infinity();
};

/// CIEDE2000 over the pixels of two images.
struct DifferenceCounts {
    ValueStatistics delta_e;
    std::array<int, 2> largest_at{};  ///< column from 0 and row of the first pixel with the largest
    std::uint64_t beyond_fail = 0;    ///< with those that have no difference: NaN or infinite colour
    std::uint64_t beyond_warn = 0;
};

/// Compares two images of equal width in `rows` of both, in Lab, each relative to its white. Memory is a
/// few blocks a worker. `map`, where it is not null, gets one plane of differences, NaN where there is
/// none. The result does not depend on the number of workers.
[[nodiscard]] Result<DifferenceCounts> difference_stream(const DifferenceSide& a, const DifferenceSide& b,
                                                         RowRange rows, const DifferenceLimits& limits,
                                                         RowSink* map, Runner& runner,
                                                         const Progress& progress);

}  // namespace osio
