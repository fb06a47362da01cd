// SPDX-License-Identifier: Apache-2.0
//
// The one file of this folder that knows the formats.
#include <formats/exr/exr_file.h>
#include <formats/image/open_image.h>

namespace osio::image {

Result<std::shared_ptr<const SpectralImage>> open_image(const std::string& path) {
    return exr::ExrFile::open(path);
}

}  // namespace osio::image
