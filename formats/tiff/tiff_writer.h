// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/replacement_file.h>
#include <formats/tiff/gdal_metadata.h>

#include <osio/layout/channel_layout.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace osio::tiff {

/// An image to be written: floats, a plane for each band.
struct TiffOutput {
    std::size_t width = 0, height = 0;
    Quantity quantity = Quantity::Reflectance;
    std::vector<double> wavelengths_nm;  ///< one a band
    std::vector<double> fwhm_nm;         ///< one a band, or none
    bool deflate = true;                 ///< behind predictor 3; else plain numbers
    std::vector<GdalItem> items;         ///< of the image, beyond those that say the above
    std::vector<std::pair<std::string, std::string>>
        texts;  ///< names of formats/tiff/text_tags.h and their text
};

/// The items of GDAL's metadata that state bands, and those of the image behind them; read_bands() understands them as what
/// they came from.
[[nodiscard]] std::vector<GdalItem> items_of(const TiffOutput& output);

/// Writes a TIFF, or a BigTIFF where four gigabytes might not do, rows from top to bottom, into a temporary beside its
/// target, which takes its place in finish().
class TiffWriter {
  public:
    /// Unsupported for more than 65535 bands, TIFF's most; Io.
    [[nodiscard]] static Result<std::unique_ptr<TiffWriter>> create(const std::string& path,
                                                                    TiffOutput output);

    TiffWriter(const TiffWriter&) = delete;
    TiffWriter& operator=(const TiffWriter&) = delete;
    ~TiffWriter();

    /// Rows of a strip, a power of two or all: blocks of as many, or of a multiple, from the top on, are packed each by
    /// its worker.
    [[nodiscard]] int rows_per_strip() const;

    /// Makes strips of rows; one for each worker.
    class Packer {
      public:
        virtual ~Packer() = default;

        /// Rows from `first_row` on, which a strip begins with: for each band a plane of row_count x width floats.
        virtual void pack(int first_row, int row_count, std::span<const float* const> planes) = 0;

        /// Writes what pack() made. One call at a time.
        [[nodiscard]] virtual Result<void> write() = 0;
    };

    [[nodiscard]] std::unique_ptr<Packer> start_packer();

    /// Fails where rows are missing or the system could not take every byte.
    [[nodiscard]] Result<void> finish(files::Durability durability = files::Durability::Handed);

  private:
    struct State;
    class StripRows;
    explicit TiffWriter(std::unique_ptr<State> state);

    std::unique_ptr<State> m_state;
};

}  // namespace osio::tiff
