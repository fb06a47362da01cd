// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_source.h>

namespace osio::exr {

/// What both kinds of reader decode.
struct BlockJob {
    std::shared_ptr<const ExrFile> file;
    std::size_t part = 0;
    PlaneChannels planes;
    BlockGrid grid;
};

/// Parts in `has_own_codec()`'s compressions without sub-sampled channels: chunks raw from OpenEXRCore,
/// over the file's one context, unpacked by stages of our own. Planes of scanlines are shown in the lines
/// that are made, those of tiles are copied from theirs.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_own_reader(const BlockJob& job);

/// True where stages of our own can unpack a part.
[[nodiscard]] bool has_own_codec(const image::Part& part);

/// Through the C++ API. Each reader opens the file for itself: the API serialises reads of one file.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_imf_reader(const BlockJob& job);

}  // namespace osio::exr
