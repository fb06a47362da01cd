// SPDX-License-Identifier: Apache-2.0
//
// The one file of this folder that knows the formats.
#include <formats/envi/envi_file.h>
#include <formats/exr/exr_file.h>
#include <formats/image/open_image.h>

namespace osio::image {

Result<std::shared_ptr<const SpectralImage>> open_image(const std::string& path) {
    if (!exr::starts_like_exr(path) && envi::find_header(path))
        return envi::EnviFile::open(path);
    return exr::ExrFile::open(path);
}

bool is_ours(const std::string& path) {
    return exr::starts_like_exr(path) || envi::find_header(path).has_value();
}

}  // namespace osio::image
