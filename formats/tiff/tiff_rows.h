// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/tiff/tiff_file.h>

#include <memory>

namespace osio::tiff {

/// Rows of the wanted channels of a part as planes of floats. Unsupported where a row of blocks needs more than
/// kMostBlockBytes.
[[nodiscard]] Result<std::unique_ptr<BlockSource>> make_row_source(std::shared_ptr<const TiffFile> file,
                                                                   std::size_t part,
                                                                   image::PlaneChannels planes,
                                                                   image::Grain grain);

}  // namespace osio::tiff
