// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_file.h>

#include <memory>

namespace osio::envi {

/// Rows of the wanted bands as planes of floats. What is read at once is contiguous in the data file: some
/// lines of one band (bsq), or one line of all bands (bil, bip). Damaged where a row needs more than
/// kMostBlockBytes.
[[nodiscard]] Result<std::unique_ptr<BlockSource>>
make_row_source(std::shared_ptr<const EnviFile> file, image::PlaneChannels planes, image::Grain grain);

}  // namespace osio::envi
