// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <plugins/common/open_options.h>
#include <plugins/spectralexr.imageio/subimage.h>

#include <OpenImageIO/imageio.h>

#include <memory>
#include <vector>

namespace osio::plugin {

/// Reads spectral OpenEXR: all parts with their bands as channels, or, where `to` names a space, the
/// chosen bands as colour.
///
/// OpenImageIO 2.4 may call open() while it holds the lock of its plugin registry: nothing here ever
/// creates or opens another ImageInput.
class SpectralExrInput final : public OIIO::ImageInput {
  public:
    [[nodiscard]] const char* format_name() const override { return "spectralexr"; }

    [[nodiscard]] int supports(OIIO::string_view feature) const override;
    [[nodiscard]] bool valid_file(const std::string& filename) const override;
    bool open(const std::string& name, OIIO::ImageSpec& spec) override;
    bool open(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override;
    bool close() override;

    [[nodiscard]] int current_subimage() const override { return m_current; }

    bool seek_subimage(int subimage, int miplevel) override;
    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override;
    bool read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, void* data) override;
    bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override;

  private:
    bool open_with(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec* config);
    Result<void> load(const std::string& name, const OIIO::ImageSpec* config);
    /// The certificate that max-delta-e asks for, as JSON; empty without it. Reads the whole image.
    Result<std::string> certify(const image::CollapseJob& job);
    Result<void> add_raw_subimages(const std::shared_ptr<const image::SpectralImage>& file,
                                   const CollapseRequest& request);
    Result<void> read(RowRange rows, std::byte* out);
    Result<void> read_tile(int x, int y, std::byte* out);
    Result<void> fill_cache(RowRange around);
    bool report(const std::string& name, const Error& error);

    std::vector<std::unique_ptr<Subimage>> m_subimages;
    int m_current = -1;

    /// The rows of one block, for hosts that ask for a line or a tile at a time.
    struct Cache {
        int subimage = -1;
        RowRange rows;
        std::vector<std::byte> pixels;
    };

    Cache m_cache;
};

}  // namespace osio::plugin
