// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/block_grid.h>
#include <formats/image/spectral_image.h>

#include <vector>

namespace osio::image {

/// Every band of a set at the middle pixel of each square of a grid over the part's data window: band after band, each
/// of them row after row. Samples as stored, rounded to float. The refusals of reading.
[[nodiscard]] Result<std::vector<float>> grid_spectra(const SpectralImage& image, const Selection& selection,
                                                      const BlockGrid& grid, Runner& runner,
                                                      const Progress& progress);

}  // namespace osio::image
