// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace osio::convert {

/// A plane of a joined block: which source it comes from, and which plane it is there.
struct JoinedPlane {
    std::size_t source = 0;
    std::size_t plane = 0;
};

/// Sources of equal windows as one. Blocks are those of the first source; the rows of the others are gathered from
/// whatever blocks they have.
[[nodiscard]] std::unique_ptr<BlockSource> join_sources(std::vector<std::unique_ptr<BlockSource>> sources,
                                                        std::vector<JoinedPlane> planes);

/// The same source in blocks of `rows_per_block` rows, from the top of the window; its readers gather rows from the
/// blocks that it has.
[[nodiscard]] std::unique_ptr<BlockSource> regroup(std::unique_ptr<BlockSource> source, RowRange window,
                                                   int rows_per_block);

}  // namespace osio::convert
