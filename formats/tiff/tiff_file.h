// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/raw_file.h>
#include <formats/image/spectral_image.h>
#include <formats/tiff/page_bands.h>

#include <osio/layout/open_words.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osio::tiff {

/// Where a channel's numbers are.
struct Plane {
    std::size_t page = 0;
    std::uint16_t sample = 0;
    image::Scaling scaling;
};

/// A TIFF or BigTIFF file. A page of several samples with wavelengths is a part, a channel a sample; pages of one sample
/// are one part together, a channel a page. Overviews and masks are left out. Channels are named as those of
/// ENVI files are; samples are floats: the file's own numbers, scaled as GDAL's metadata say.
class TiffFile final : public image::SpectralImage, public std::enable_shared_from_this<TiffFile> {
  public:
    /// Io where the system refuses; NotSpectral where it is no TIFF or nothing in it has a wavelength; Damaged and
    /// Unsupported as read_page() and read_bands(); Unsupported where pages of one sample differ in size.
    ///
    /// A map of wavelengths among the user's words takes the place of the file's: its steps are for the samples, or
    /// the pages of one sample, in their order, a table knows them as `band.N`. Contradiction where it fits no part, or
    /// where `quantity` is not what the file says.
    [[nodiscard]] static Result<std::shared_ptr<const TiffFile>> open(const std::string& path,
                                                                      const OpenWords& words = {});

    /// The same for a file that is one band of a stack: without a wavelength its channel is `band.1`. Whole numbers are
    /// divided by `scale` where it is given; Usage where the file holds floats or says how to scale them itself.
    [[nodiscard]] static Result<std::shared_ptr<const TiffFile>>
    open_band(const std::string& path, const OpenWords& words, std::optional<double> scale);

    [[nodiscard]] std::string_view format() const override { return "TIFF"; }

    /// The file's pages, without overviews and masks.
    [[nodiscard]] const std::vector<Page>& pages() const { return m_pages; }

    /// By channel of a part.
    [[nodiscard]] const std::vector<Plane>& planes(std::size_t part) const { return m_planes[part]; }

    [[nodiscard]] const std::shared_ptr<const files::RawFile>& data() const { return m_data; }

    /// Blocks of whole strips or tiles; memory is that of a block's planes and of one strip, or a row of tiles.
    [[nodiscard]] Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t part, image::PlaneChannels planes, image::Grain grain) const override;

  private:
    TiffFile(const std::string& path, std::shared_ptr<const files::RawFile> data)
        : SpectralImage(path), m_data(std::move(data)) {}

    [[nodiscard]] static Result<std::shared_ptr<TiffFile>> open_pages(const std::string& path);
    [[nodiscard]] Result<void> read(const OpenWords& words);
    [[nodiscard]] Result<void> read_band(const OpenWords& words, std::optional<double> scale);

    /// One part of some pages.
    [[nodiscard]] Result<void> add_part(const std::vector<std::size_t>& pages, const OpenWords& words);

    std::shared_ptr<const files::RawFile> m_data;
    std::vector<Page> m_pages;
    std::vector<PageBands> m_bands;       ///< by page
    std::vector<std::string> m_warnings;  ///< of the file
    std::vector<std::vector<Plane>> m_planes;
};

/// True where a file exists and starts as TIFF and BigTIFF files do, in either byte order.
[[nodiscard]] bool starts_like_tiff(const std::string& path);

}  // namespace osio::tiff
