// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_file.h>

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace osio::plugin {

/// Reads ENVI cubes: the file's own numbers, unscaled, as channels under the layout's names. Names with a
/// query (`cube.hdr?to=srgb`) are spectralexr's.
///
/// OpenImageIO may call valid_file() and open() while it holds the lock of its plugin registry: nothing here
/// creates another ImageInput.
class EnviInput final : public OIIO::ImageInput {
  public:
    [[nodiscard]] const char* format_name() const override { return "envi"; }

    [[nodiscard]] int supports(OIIO::string_view feature) const override {
        return feature == "arbitrary_metadata";
    }

    /// True for a header that can be read, or a data file with one beside it. `.hdr` is also Radiance's, `.raw`
    /// a camera's.
    [[nodiscard]] bool valid_file(const std::string& filename) const override;
    bool open(const std::string& name, OIIO::ImageSpec& spec) override;
    bool close() override;
    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override;
    bool read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, void* data) override;

  private:
    std::shared_ptr<const envi::EnviFile> m_file;
    std::vector<std::size_t> m_bands;  // by channel
};

}  // namespace osio::plugin
