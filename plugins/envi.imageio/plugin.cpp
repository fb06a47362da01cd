// SPDX-License-Identifier: Apache-2.0
//
// The names that OpenImageIO looks for in envi.imageio.so.

#include <plugins/envi.imageio/input.h>

#include <OpenImageIO/imageio.h>

OIIO_PLUGIN_EXPORTS_BEGIN

OIIO_EXPORT const char* envi_imageio_library_version();
OIIO_EXPORT OIIO::ImageInput* envi_input_imageio_create();

OIIO_EXPORT int envi_imageio_version = OIIO_PLUGIN_VERSION;

const char* envi_imageio_library_version() {
    return "OpenSpectralIO " OSIO_VERSION;
}

OIIO::ImageInput* envi_input_imageio_create() {
    return new osio::plugin::EnviInput;
}

// Not .hdr and .raw, which other readers own: after them OpenImageIO asks every valid_file().
OIIO_EXPORT const char* envi_input_extensions[] = {"envi", "bsq", "bil", "bip", nullptr};

OIIO_PLUGIN_EXPORTS_END
