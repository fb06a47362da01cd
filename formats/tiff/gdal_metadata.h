// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osio::tiff {

/// One entry of the text of tag 42112: of a sample, or of the image.
struct GdalItem {
    std::string name;
    std::string value;
    std::optional<std::size_t> sample;  ///< counted from 0
    std::string domain;                 ///< empty: GDAL's own
    std::string role;                   ///< "scale", "offset", "description", "unittype", ...

    friend bool operator==(const GdalItem&, const GdalItem&) = default;
};

/// Reads
///
///     <GDALMetadata>
///       <Item name="wavelength" sample="0" domain="" role="">450.5</Item> ...
///     </GDALMetadata>
///
/// Damaged where it is no XML of that form. Items whose value is XML of its own are left out.
[[nodiscard]] Result<std::vector<GdalItem>> parse_gdal_metadata(std::string_view xml);

/// The text that parse_gdal_metadata() reads as these items.
[[nodiscard]] std::string gdal_metadata_text(std::span<const GdalItem> items);

}  // namespace osio::tiff
