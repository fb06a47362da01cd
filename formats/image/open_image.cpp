// SPDX-License-Identifier: Apache-2.0
//
// The one file of this folder that knows the formats.
#include <formats/envi/envi_file.h>
#include <formats/exr/exr_file.h>
#include <formats/image/open_image.h>
#include <formats/image/scene_basis.h>
#include <formats/stack/png_file.h>
#include <formats/stack/stack.h>
#include <formats/tiff/tiff_file.h>

namespace osio::image {

Result<std::shared_ptr<const SpectralImage>> open_image(const std::string& path, const OpenWords& words) {
    if (tiff::starts_like_tiff(path))
        return tiff::TiffFile::open(path, words);
    if (stack::starts_like_stack(path))
        return stack::open_stack_file(path, words);
    if (stack::starts_like_png(path))
        return fail(ErrorCode::NotSpectral,
                    "is a PNG file, which is one band at most; list the files of all bands in a text whose "
                    "first line "
                    "is " +
                        std::string(stack::kStackMagic) + ", or use convert --assemble",
                    path);
    if (!exr::starts_like_exr(path) && envi::find_header(path))
        return envi::EnviFile::open(path, words);
    auto file = exr::ExrFile::open(path, words);
    if (!file && file.error().code == ErrorCode::NotSpectral)
        return fail(ErrorCode::NotSpectral, file.error().what + ", no TIFF file, and there is no ENVI header",
                    path);
    if (!file)
        return tl::unexpected(std::move(file).error());
    return expand_scene_basis(std::move(*file));
}

bool is_ours(const std::string& path) {
    return exr::starts_like_exr(path) || tiff::starts_like_tiff(path) || stack::starts_like_stack(path) ||
           envi::find_header(path).has_value();
}

}  // namespace osio::image
