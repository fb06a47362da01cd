// SPDX-License-Identifier: Apache-2.0
#include <formats/files/png_output.h>

#include <png.h>

namespace osio::files {

Result<std::string> png_of_srgb(std::span<const std::uint8_t> samples, std::size_t width) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(samples.size() / (3 * width));
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string out(bytes, '\0');
    if (png_image_write_to_memory(&image, out.data(), &bytes, 0, samples.data(), 0, nullptr) == 0)
        return fail(ErrorCode::Io, std::string("no PNG can be made: ") + image.message);
    out.resize(bytes);
    return out;
}

}  // namespace osio::files
