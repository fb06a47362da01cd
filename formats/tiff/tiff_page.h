// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/number_rows.h>
#include <formats/tiff/tiff_handle.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace osio::tiff {

/// One image of a file: what its directory says.
struct Page {
    std::uint64_t directory = 0;  ///< where it lies in the file
    std::uint32_t width = 0, height = 0;
    std::uint16_t samples = 1;  ///< a pixel
    image::NumberType type = image::NumberType::Uint8;
    bool planar = false;  ///< each sample in strips or tiles of its own
    bool tiled = false;
    std::uint32_t block_width = 0, block_height = 0;  ///< of a tile, or of a strip
    bool big_endian = false;
    /// Strips hold the numbers themselves, row after row.
    bool plain = false;
    std::string compression;  ///< OpenImageIO's words
    std::vector<bool> alpha;  ///< by sample

    std::vector<std::pair<std::string, std::string>>
        texts;                                     ///< "ImageDescription", "Software", ... and their text
    std::string gdal_metadata, gdal_no_data, xmp;  ///< as they stand in the file

    /// The text of that name; empty where there is none.
    [[nodiscard]] std::string text(std::string_view name) const;

    /// Bytes of a strip or tile of `rows` rows, unpacked.
    [[nodiscard]] std::uint64_t block_bytes(std::uint64_t rows) const;
};

/// True where the directory at which a handle stands is an overview of another page, or a mask.
[[nodiscard]] bool is_reduced(const Handle& handle);

/// Understands the directory at which a handle stands. Damaged where its sizes exceed formats/image/limits.h;
/// Unsupported for numbers and packings that are none of ours.
[[nodiscard]] Result<Page> read_page(Handle& handle);

}  // namespace osio::tiff
