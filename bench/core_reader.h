// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_readers.h>

namespace osio::exr {

/// OpenEXRCore's own stages, chunk by chunk, straight into the planes: what the product is compared with.
[[nodiscard]] Result<std::unique_ptr<BlockReader>> make_core_reader(const BlockJob& job);

}  // namespace osio::exr
