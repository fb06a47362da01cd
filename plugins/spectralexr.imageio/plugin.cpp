// SPDX-License-Identifier: Apache-2.0
//
// The six names that OpenImageIO looks for in spectralexr.imageio.so.

#include <plugins/spectralexr.imageio/input.h>
#include <plugins/spectralexr.imageio/output.h>

#include <OpenImageIO/imageio.h>

OIIO_PLUGIN_EXPORTS_BEGIN

OIIO_EXPORT const char* spectralexr_imageio_library_version();
OIIO_EXPORT OIIO::ImageInput* spectralexr_input_imageio_create();
OIIO_EXPORT OIIO::ImageOutput* spectralexr_output_imageio_create();

OIIO_EXPORT int spectralexr_imageio_version = OIIO_PLUGIN_VERSION;

const char* spectralexr_imageio_library_version() {
    return "OpenSpectralIO " OSIO_VERSION;
}

OIIO::ImageInput* spectralexr_input_imageio_create() {
    return new osio::plugin::SpectralExrInput;
}

OIIO_EXPORT const char* spectralexr_input_extensions[] = {"spexr", "spectral", nullptr};

OIIO::ImageOutput* spectralexr_output_imageio_create() {
    return new osio::plugin::SpectralExrOutput;
}

OIIO_EXPORT const char* spectralexr_output_extensions[] = {"spexr", nullptr};

OIIO_PLUGIN_EXPORTS_END
