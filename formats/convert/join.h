// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace osio::convert {

/// Several images as one part.
struct Joined {
    std::shared_ptr<const image::SpectralImage> image;
    std::vector<std::string> lost;
};

/// Puts the channels of all images side by side: of every part with bands, or of the one that `part` names in each.
/// Windows must be equal. Attributes come from all; of two that say something else the first stays. Widths are merged;
/// bin edges go where more than one image has bands. Two bands of one name are refused (Usage), other channels of one
/// name, such as alpha, come from the first image that has them. What goes is in `lost`.
[[nodiscard]] Result<Joined> join_images(std::span<const std::shared_ptr<const image::SpectralImage>> images,
                                         const std::string& part);

}  // namespace osio::convert
