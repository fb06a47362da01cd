// SPDX-License-Identifier: Apache-2.0
//
// The one file of this folder that knows the formats.
#include <formats/envi/envi_file.h>
#include <formats/exr/exr_file.h>
#include <formats/image/open_image.h>

namespace osio::image {

Result<std::shared_ptr<const SpectralImage>> open_image(const std::string& path, const OpenWords& words) {
    if (!exr::starts_like_exr(path) && envi::find_header(path))
        return envi::EnviFile::open(path, words);
    auto file = exr::ExrFile::open(path, words);
    if (!file && file.error().code == ErrorCode::NotSpectral)
        return fail(ErrorCode::NotSpectral, file.error().what + ", and there is no ENVI header", path);
    return file;
}

bool is_ours(const std::string& path) {
    return exr::starts_like_exr(path) || envi::find_header(path).has_value();
}

}  // namespace osio::image
