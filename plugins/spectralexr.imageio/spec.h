// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <OpenImageIO/imageio.h>

namespace osio::plugin {

/// The host's word for a sample's type.
[[nodiscard]] inline OIIO::TypeDesc host_type(SampleType type) {
    switch (type) {
    case SampleType::Half: return OIIO::TypeHalf;
    case SampleType::Float: return OIIO::TypeFloat;
    case SampleType::Uint: break;
    }
    return OIIO::TypeUInt32;
}

/// A spec with the part's data and display window and nothing else decided: no channels, scanlines.
[[nodiscard]] inline OIIO::ImageSpec spec_of_windows(const image::Part& part) {
    OIIO::ImageSpec spec;
    spec.x = part.data_window.min_x;
    spec.y = part.data_window.min_y;
    spec.width = part.data_window.width();
    spec.height = part.data_window.height();
    spec.full_x = part.display_window.min_x;
    spec.full_y = part.display_window.min_y;
    spec.full_width = part.display_window.width();
    spec.full_height = part.display_window.height();
    spec.depth = spec.full_depth = 1;
    spec.format = OIIO::TypeUnknown;
    return spec;
}

}  // namespace osio::plugin
