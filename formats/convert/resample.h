// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/collapse/resampling.h>

namespace osio::convert {

/// A part of an image with its bands at other wavelengths.
struct Resampled {
    std::shared_ptr<const image::SpectralImage> image;  ///< of one part
    std::vector<std::string> lost;
    std::vector<std::string> warnings;
};

/// Resamples every set of the part; `selection` says which one must be possible, others that are not go. Where every
/// set has these wavelengths already the image is the source's part as it is, bit for bit. What describes the old bands
/// (widths, sensitivities, reradiation, a preview R, G, B, lists that count bands) is lost, and `lost` says so;
/// stated bin edges become the new ones. The refusals of plan_resampling().
[[nodiscard]] Result<Resampled> resample(std::shared_ptr<const image::SpectralImage> image,
                                         const Selection& selection, const Resampling& resampling);

}  // namespace osio::convert
