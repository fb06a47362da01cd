// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/collapse/difference_stream.h>
#include <osio/collapse/plan.h>

#include <optional>
#include <string>
#include <vector>

namespace osio::image {

/// An image whose pixels have an XYZ, whatever its channels: bands under a request, or R, G, B or X, Y, Z.
struct ColourImage {
    std::shared_ptr<const SpectralImage> file;
    std::size_t part_index = 0;
    PlaneChannels planes;
    XyzRecipe recipe;
    bool spectral = false;
    std::string meaning;                ///< how it was understood, for people
    std::vector<std::string> warnings;  ///< what was assumed
    std::optional<Error> denied;        ///< why it was read without what the request says of files

    [[nodiscard]] const Part& part() const { return file->parts()[part_index]; }

    [[nodiscard]] Result<std::unique_ptr<BlockSource>> open_source() const;
};

/// Opens an OpenEXR file. Bands are collapsed by `request` to XYZ, which Lab refers to the plan's white.
/// Without bands, R, G, B are those of `oiio:ColorSpace` where that is a space we know (its curve is
/// undone), else of `chromaticities`, else linear Rec.709, with a warning; X, Y, Z are themselves. Lab
/// then refers to the space's white, to D65 where only X, Y, Z are known. NotSpectral where there is
/// neither; the refusals of a plan. Where the request's `wavelengths` or `quantity` do not fit, the image is read without
/// them, with a warning: of two images they may be meant for the other.
[[nodiscard]] Result<ColourImage> open_colour_image(const std::string& path, const CollapseRequest& request,
                                                    const TextLoader& load_text);

}  // namespace osio::image
