// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <cstdint>
#include <vector>

namespace osio::image {

/// A band's samples over some pixels.
struct BandSpread {
    double wavelength_nm = 0;
    double mean = 0;  ///< as the rest, 0 where no sample is a finite number
    double minimum = 0;
    double maximum = 0;
    std::uint64_t undefined = 0;  ///< samples that are NaN or infinite, which go into nothing else
};

/// Every band of a set over the pixels of `region`, in the coordinates of the data window, in double. One
/// entry a band, in the order of the set. Usage where the region is not inside the data window; refusals
/// of reading.
[[nodiscard]] Result<std::vector<BandSpread>>
region_spectrum(const SpectralImage& image, const Selection& selection, const Window& region);

}  // namespace osio::image
