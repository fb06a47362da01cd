// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

#include <memory>
#include <vector>

namespace osio::exr {

/// A source whose planes are multiplied, each by its own factor in double and rounded once to float; planes of
/// factor 1 stay what they are.
[[nodiscard]] std::unique_ptr<BlockSource> with_factors(std::unique_ptr<BlockSource> source,
                                                        std::vector<double> factors);

}  // namespace osio::exr
