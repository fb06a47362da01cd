// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <plugins/spectralexr.imageio/output_image.h>

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

namespace osio::plugin {

/// Writes spectral OpenEXR: one or several parts, of scanlines or of tiles, bands under the layout's names, the
/// layout's attributes, half, float or uint for each channel. One of the parts at least has bands.
///
/// R, G, B beside the bands are a preview. Where they no longer show the bands they are left out, and
/// a warning says so; to know it, a file with such a part is held until close(). All others are written
/// row by row. With the metadata `spectral:preview` R, G, B are made of the bands instead.
class SpectralExrOutput final : public OIIO::ImageOutput {
  public:
    SpectralExrOutput() = default;
    SpectralExrOutput(const SpectralExrOutput&) = delete;
    SpectralExrOutput& operator=(const SpectralExrOutput&) = delete;
    ~SpectralExrOutput() override;

    [[nodiscard]] const char* format_name() const override { return "spectralexr"; }

    [[nodiscard]] int supports(OIIO::string_view feature) const override;
    bool open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode) override;
    bool open(const std::string& name, int subimages, const OIIO::ImageSpec* specs) override;
    bool write_scanline(int y, int z, OIIO::TypeDesc format, const void* data,
                        OIIO::stride_t xstride) override;
    bool write_scanlines(int ybegin, int yend, int z, OIIO::TypeDesc format, const void* data,
                         OIIO::stride_t xstride, OIIO::stride_t ystride) override;
    bool write_tile(int x, int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride,
                    OIIO::stride_t ystride, OIIO::stride_t zstride) override;
    bool close() override;

  private:
    [[nodiscard]] OutputImage& current() { return m_images[m_current]; }

    Result<void> start(int subimages, const OIIO::ImageSpec* specs);
    Result<void> start_writer();
    bool next_subimage(const OIIO::ImageSpec& spec);
    Result<void> write_native_rows(const std::byte* rows, int row_count);
    /// Packed on the host's threads.
    Result<void> write_rows(std::size_t subimage, const std::byte* rows, int row_count);
    Result<void> finish();
    bool fail_with(const Error& error);

    bool m_open = false;
    std::string m_name;
    std::vector<OutputImage> m_images;
    std::size_t m_current = 0;
    bool m_held = false;  ///< until close(): a preview must be compared first
    bool m_fsync = false;
    std::unique_ptr<exr::ExrWriter> m_writer;
    std::vector<std::byte> m_tiles;  ///< rows of pixels of a row of tiles
    int m_tile_column = 0;           ///< of the tile that comes next
    std::vector<unsigned char> m_scratch;
};

}  // namespace osio::plugin
