// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/band_facts.h>
#include <formats/image/number_rows.h>
#include <formats/tiff/gdal_metadata.h>
#include <formats/tiff/tiff_page.h>

#include <optional>
#include <string>
#include <vector>

namespace osio::tiff {

/// What a page says of its samples. Lists have one entry a sample.
struct PageBands {
    std::vector<image::BandFacts> facts;
    std::vector<image::Scaling> scaling;
    std::optional<Quantity> quantity;  ///< nothing where the page does not say
    std::string units;                 ///< of a radiance, in the file's words
    std::vector<GdalItem> others;      ///< of the image, that say nothing of the above
    std::vector<std::string> warnings;

    /// True where a sample has a wavelength.
    [[nodiscard]] bool spectral() const;
};

/// Reads GDAL's tags; without wavelengths there, those of XMP (`Camera:CentralWavelength`, `Camera:WavelengthFWHM`), and
/// for a page of one sample the one that its ImageDescription, PageName or DocumentName names. docs/formats.md lists
/// the items and which is believed before which. Damaged where tag 42112 is no XML of GDAL's, a list has not one
/// item a sample, or a number is none.
[[nodiscard]] Result<PageBands> read_bands(const Page& page);

}  // namespace osio::tiff
