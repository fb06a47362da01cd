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

/// Through OpenEXRCore: chunk by chunk, straight into the planes, over the file's one context.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_core_reader(const BlockJob& job);

/// Through the C++ API. Each reader opens the file for itself: the API serialises reads of one file.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_imf_reader(const BlockJob& job);

}  // namespace osio::exr
