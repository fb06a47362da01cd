// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_readers.h>

namespace osio::exr {

/// The reader, with every chunk of a block looked at (ChunkMap::check) before the block is decoded.
/// Whatever fails says which rows it was in.
[[nodiscard]] std::unique_ptr<BlockReader> guarded(std::unique_ptr<BlockReader> reader, const BlockJob& job);

}  // namespace osio::exr
