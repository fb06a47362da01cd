// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/base/result.h>
#include <osio/layout/open_words.h>

#include <vector>

namespace osio::exr {

/// Fills in what the channels of an OpenEXR file's parts are: layout, metadata, and in the header the attributes
/// that the layout has for what another dialect says by other means. Where the user's words fit some parts, the
/// others are read without them, with a warning; Contradiction where they fit none.
[[nodiscard]] Result<void> understand_bands(std::vector<image::Part>& parts, const OpenWords& words);

}  // namespace osio::exr
