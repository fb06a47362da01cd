// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/region_spectrum.h>

#include <string>
#include <vector>

namespace osio::tool {

/// A spectrum as an SVG picture: mean over wavelength with a mark at every band, the range from minimum to
/// maximum behind it, axes with round numbers. `spread` is in order of wavelength and has an entry.
[[nodiscard]] std::string spectrum_plot(const std::vector<image::BandSpread>& spread,
                                        const std::string& title, const std::string& quantity);

}  // namespace osio::tool
