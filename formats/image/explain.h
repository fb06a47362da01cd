// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <cstdint>
#include <string>
#include <vector>

/// What a collapse will do and what it does without, told before it does it.
namespace osio::image {

/// What happens to every pixel, or does not.
struct Step {
    std::string name;       ///< "read", "sum", "exposure", ...
    std::string what;       ///< in words
    bool identity = false;  ///< it changes nothing, and nothing is done for it
};

/// Something that the file holds or a collapse could make, and that this one needs not.
struct LeftOut {
    std::string what;
    std::string why;
};

struct Explanation {
    std::uint64_t pixels = 0;        ///< of the data window
    std::uint64_t samples = 0;       ///< unpacked from the file
    std::uint64_t sample_bytes = 0;  ///< of those, as they are stored
    std::uint64_t products = 0;      ///< weight times sample
    std::vector<Step> steps;         ///< in the order of a pixel's way
    std::vector<LeftOut> left_out;
};

/// Reads no pixel.
[[nodiscard]] Explanation explain(const CollapseJob& job);

}  // namespace osio::image
