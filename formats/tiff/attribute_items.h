// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/tiff/gdal_metadata.h>
#include <formats/tiff/tiff_writer.h>

#include <OpenEXR/ImfHeader.h>

#include <string>
#include <string_view>

namespace osio::tiff {

/// Domain of the items that are attributes of OpenEXR: their name is `TYPE NAME`.
inline constexpr std::string_view kExrDomain = "EXR";

/// Prefix of the names under which other items of an image are attributes: `gdal:NAME`, `gdal:DOMAIN:NAME`.
inline constexpr std::string_view kGdalPrefix = "gdal:";

/// Inserts an item of the image as the attribute that it came from, else as a string under its domain and name.
void insert_item(const GdalItem& item, Imf::Header& header);

/// Adds an attribute to an output, in the way in which insert_item() and a text tag give it back. False where it has
/// another type than string, int, float and double, is not finite, holds what XML cannot, or is stated by the
/// writer itself.
[[nodiscard]] bool add_attribute(const std::string& name, const Imf::Attribute& attribute,
                                 TiffOutput& output);

}  // namespace osio::tiff
