// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <plugins/spectralexr.imageio/preview_samples.h>

#include <formats/exr/exr_writer.h>

#include <OpenImageIO/imageio.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osio::plugin {

/// Metadata (int, not 0) by which a host asks that close() succeeds only when the storage has every byte.
inline constexpr const char* kFsyncAttribute = "spectral:fsync";

/// Writes spectral OpenEXR: one scanline part, bands under the layout's names, the layout's
/// attributes, half, float or uint for each channel.
///
/// R, G, B beside the bands are a preview. Where they no longer show the bands they are left out, and
/// a warning says so; to know it, an image with both is held until close(). All others are written
/// row by row.
class SpectralExrOutput final : public OIIO::ImageOutput {
  public:
    SpectralExrOutput() = default;
    SpectralExrOutput(const SpectralExrOutput&) = delete;
    SpectralExrOutput& operator=(const SpectralExrOutput&) = delete;
    ~SpectralExrOutput() override;

    [[nodiscard]] const char* format_name() const override { return "spectralexr"; }

    [[nodiscard]] int supports(OIIO::string_view feature) const override;
    bool open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode) override;
    bool write_scanline(int y, int z, OIIO::TypeDesc format, const void* data,
                        OIIO::stride_t xstride) override;
    bool write_scanlines(int ybegin, int yend, int z, OIIO::TypeDesc format, const void* data,
                         OIIO::stride_t xstride, OIIO::stride_t ystride) override;
    bool close() override;

  private:
    Result<void> start();
    Result<void> write_native_rows(const std::byte* rows, int row_count);
    Result<void> finish();
    [[nodiscard]] bool is_preview(std::size_t channel) const;
    bool drop_stale_preview();
    [[nodiscard]] Result<std::unique_ptr<exr::ExrWriter>> make_writer(bool with_preview) const;
    Result<void> write_held_rows(bool with_preview);
    /// Packed on the host's threads.
    Result<void> write_planes(int row_count, const std::vector<exr::ChannelRows>& channels);
    bool fail_with(const Error& error);

    bool m_open = false;
    std::string m_name;
    ChannelLayout m_layout;  ///< of the names that are written
    std::vector<SampleType> m_types;
    std::vector<std::ptrdiff_t> m_offsets;  ///< of each channel inside a pixel, bytes
    std::optional<PreviewChannels> m_preview;
    std::vector<PreviewSample> m_source_samples;
    std::vector<std::byte> m_held;  ///< rows, where a preview must be checked first
    std::unique_ptr<exr::ExrWriter> m_writer;
    int m_next_row = 0;
    std::vector<unsigned char> m_scratch;
};

}  // namespace osio::plugin
