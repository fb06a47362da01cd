// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tiffio.h>

namespace osio::tiff {

/// Tags of GDAL, which libtiff does not know.
inline constexpr std::uint32_t kGdalMetadata = 42112;
inline constexpr std::uint32_t kGdalNoData = 42113;

/// A tag that holds text for people.
struct TextTag {
    std::uint32_t tag;
    const char* name;
};

inline constexpr std::array<TextTag, 9> kTextTags{{{TIFFTAG_IMAGEDESCRIPTION, "ImageDescription"},
                                                   {TIFFTAG_DOCUMENTNAME, "DocumentName"},
                                                   {TIFFTAG_PAGENAME, "PageName"},
                                                   {TIFFTAG_MAKE, "Make"},
                                                   {TIFFTAG_MODEL, "Model"},
                                                   {TIFFTAG_SOFTWARE, "Software"},
                                                   {TIFFTAG_DATETIME, "DateTime"},
                                                   {TIFFTAG_ARTIST, "Artist"},
                                                   {TIFFTAG_COPYRIGHT, "Copyright"}}};

/// Attributes of these names are those tags.
inline constexpr std::string_view kTextPrefix = "tiff:";

[[nodiscard]] constexpr std::optional<std::uint32_t> find_text_tag(std::string_view name) {
    for (const TextTag& known : kTextTags)
        if (known.name == name)
            return known.tag;
    return std::nullopt;
}

}  // namespace osio::tiff
