// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/convert.h>
#include <formats/image/spectral_image.h>

#include <memory>

namespace osio::convert {

/// What goes over: one part of an image, which of its channels, and what it says about them.
struct Choice {
    std::shared_ptr<const image::SpectralImage> image;
    std::size_t part_index = 0;
    SpectralSet set;                    ///< the chosen set, with the bands that go over
    std::vector<std::size_t> channels;  ///< of the part, in its order
    Imf::Header attributes;             ///< its windows and every attribute that is still true
    std::vector<std::string> lost;

    [[nodiscard]] const image::Part& part() const { return image->parts()[part_index]; }

    [[nodiscard]] image::PlaneChannels planes() const { return {channels.begin(), channels.end()}; }
};

/// Chooses by the request's words. `everything`: all channels but bands outside the range; else the set's bands
/// only, in order of wavelength.
[[nodiscard]] Result<Choice> choose(const Request& request, bool everything);

/// "R, G, B and 4 more".
[[nodiscard]] std::string names_text(const std::vector<std::string>& names);

}  // namespace osio::convert
