// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace osio::image {

/// A channel of a derived image: a channel of the source as it is, or a weighted sum of several.
struct DerivedChannel {
    struct Term {
        std::size_t channel = 0;  ///< of the source's part
        double weight = 0;
    };

    Channel channel;                    ///< its name, and the type of what is written of it
    std::optional<std::size_t> source;  ///< nothing: the sum of `terms`, in double, rounded once to float
    std::vector<Term> terms;
};

/// One part of an image with other channels and attributes. It is read block by block like its source; no pixel is
/// touched before. `header` gives windows and attributes.
[[nodiscard]] std::shared_ptr<const SpectralImage> derive_image(std::shared_ptr<const SpectralImage> source,
                                                                std::size_t part,
                                                                std::vector<DerivedChannel> channels,
                                                                Imf::Header header);

/// The names of a part's channels in an image that is derived from it: their own where they are of the spectral EXR
/// layout, which is what attributes name too; those that are written where another dialect or the user named bands.
[[nodiscard]] std::vector<std::string> derived_names(const Part& part);

/// A part with these channels and what its names and attributes mean; windows are the header's.
[[nodiscard]] Part described_part(std::vector<Channel> channels, Imf::Header header);

}  // namespace osio::image
