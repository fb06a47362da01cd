// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/block_grid.h>
#include <formats/trade/choice.h>

#include <cstdint>
#include <string>
#include <vector>

namespace osio::trade {

/// Pictures on a page are at most this long, pixels.
inline constexpr int kMostPicturePixels = 480;

/// What a page shows of a choice.
struct ChoiceView {
    std::string name;
    std::size_t picture = 0;  ///< in the list of pictures
    std::size_t clipped = 0;  ///< squares of the picture that 8 bits of sRGB do not reach
    std::string delta_e;      ///< codes_of_differences() of the squares' largest CIEDE2000, as a zlib stream
    double delta_e_unit = 1;
};

/// What a page shows of an image besides its table, small enough to be one file.
struct PageContent {
    image::BlockGrid grid;
    std::vector<std::string> pictures;  ///< PNG files, no two the same
    std::vector<ChoiceView> choices;    ///< in the order of the choices
    image::BlockGrid spectra_grid;      ///< its side is a multiple of the other's
    std::string spectra;                ///< codes_of_samples() of grid_spectra(), as a zlib stream
    double spectra_unit = 1;
};

/// Looks at every pixel once more. Squares are as small as kMostPicturePixels and `most_bytes` of all streams
/// together, 1 MB or more, allow: pictures have at most two thirds of them, spectra the rest. The refusals of reading and
/// of png_of_srgb().
[[nodiscard]] Result<PageContent> make_page_content(const image::CollapseJob& job, const Choices& choices,
                                                    std::size_t most_bytes, Runner& runner,
                                                    const Progress& progress);

}  // namespace osio::trade
