// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/exr_file.h>

#include <osio/collapse/stream.h>

#include <cstddef>
#include <memory>

namespace osio::exr {

/// How a part is cut into blocks: chunks of scanlines, several where a chunk is one line, or rows
/// of tiles. Blocks are numbered from the top.
struct BlockGrid {
    Window window;
    int rows_per_block = 0;

    [[nodiscard]] std::size_t block_count() const;
    [[nodiscard]] int first_row(std::size_t block) const;
    [[nodiscard]] int row_count(std::size_t block) const;
};

/// The grid of a part, decided by its compression and tiles: Grain::Chunk is one chunk of
/// scanlines.
[[nodiscard]] BlockGrid block_grid(const image::Part& part, Grain grain = Grain::Block);

/// Decodes channels of one part into planar blocks: by stages of our own, or through the C++ API where
/// there are none (PIZ, DWA, parts with sub-sampled channels).
/// Planes are samples as stored. Refuses deep parts, sub-sampled channels among the wanted, and
/// blocks beyond our limits. The source keeps the file open.
[[nodiscard]] Result<std::unique_ptr<BlockSource>> make_block_source(std::shared_ptr<const ExrFile> file,
                                                                     std::size_t part, PlaneChannels planes,
                                                                     Grain grain = Grain::Block);

}  // namespace osio::exr
