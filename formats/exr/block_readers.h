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

/// ZIP and ZIPS without sub-sampled channels: chunks raw from OpenEXRCore, over the file's one context;
/// inflated by libdeflate and put in order. Planes of scanlines are shown in the lines that are made.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_zip_reader(const BlockJob& job);

/// Scanlines without compression or sub-sampled channels: planes are shown in the lines that are read.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_stored_reader(const BlockJob& job);

/// Through OpenEXRCore's own stages: chunk by chunk, straight into the planes.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_core_reader(const BlockJob& job);

/// Through the C++ API. Each reader opens the file for itself: the API serialises reads of one file.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_imf_reader(const BlockJob& job);

}  // namespace osio::exr
