// SPDX-License-Identifier: Apache-2.0
#include <formats/files/text_file.h>
#include <formats/image/limits.h>
#include <formats/tiff/text_tags.h>
#include <formats/tiff/tiff_page.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace osio::tiff {

namespace {

struct Compression {
    std::uint16_t code;
    const char* word;
};

constexpr std::array<Compression, 11> kCompressions{{{COMPRESSION_NONE, "none"},
                                                     {COMPRESSION_LZW, "lzw"},
                                                     {COMPRESSION_PACKBITS, "packbits"},
                                                     {COMPRESSION_ADOBE_DEFLATE, "zip"},
                                                     {COMPRESSION_DEFLATE, "zip"},
                                                     {COMPRESSION_JPEG, "jpeg"},
                                                     {COMPRESSION_LZMA, "lzma"},
                                                     {COMPRESSION_ZSTD, "zstd"},
                                                     {COMPRESSION_WEBP, "webp"},
                                                     {COMPRESSION_LERC, "lerc"},
                                                     {COMPRESSION_JXL, "jxl"}}};

/// Packed pages that are larger than kSmallBytes have at least one byte in the file for each kMostRatio.
constexpr std::uint64_t kSmallBytes = std::uint64_t{1} << 26;
constexpr std::uint64_t kMostRatio = std::uint64_t{1} << 16;

template <class T>
T field(TIFF* tiff, std::uint32_t tag, T otherwise) {
    T value = otherwise;
    return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

/// A tag of text, or of bytes that are text. How it is handed over depends on who made it known to libtiff: nobody,
/// libtiff itself, or a host that has GDAL.
Result<std::string> text_of(TIFF* tiff, std::uint32_t tag) {
    const TIFFField* const known = TIFFFindField(tiff, tag, TIFF_ANY);
    if (known == nullptr)
        return std::string();
    const TIFFDataType type = TIFFFieldDataType(known);
    if (type != TIFF_ASCII && type != TIFF_BYTE && type != TIFF_UNDEFINED)
        return std::string();
    const char* text = nullptr;
    std::size_t length = 0;
    if (TIFFFieldPassCount(known) == 0) {
        if (type != TIFF_ASCII || TIFFGetField(tiff, tag, &text) != 1 || text == nullptr)
            return std::string();
        length = std::strlen(text);
    } else if (TIFFFieldReadCount(known) == TIFF_VARIABLE2) {
        std::uint32_t count = 0;
        if (TIFFGetField(tiff, tag, &count, &text) != 1 || text == nullptr)
            return std::string();
        length = ::strnlen(text, count);
    } else if (TIFFFieldReadCount(known) == TIFF_VARIABLE) {
        std::uint16_t count = 0;
        if (TIFFGetField(tiff, tag, &count, &text) != 1 || text == nullptr)
            return std::string();
        length = ::strnlen(text, count);
    }
    if (length > files::kMostTextBytes)
        return fail(ErrorCode::Damaged, "tag " + std::to_string(tag) + " has " + std::to_string(length) +
                                            " bytes of text, more than " +
                                            std::to_string(files::kMostTextBytes));
    return std::string(text == nullptr ? "" : text, length);
}

Result<image::NumberType> number_type(std::uint16_t bits, std::uint16_t format) {
    using image::NumberType;
    const auto refused = [&](const char* what) {
        return fail(ErrorCode::Unsupported,
                    std::string(what) + " of " + std::to_string(bits) +
                        " bits; expected integers of 8, 16, 32 or 64 bits or floats of 16, 32 or 64");
    };
    switch (format) {
    case SAMPLEFORMAT_VOID:
    case SAMPLEFORMAT_UINT:
        switch (bits) {
        case 8: return NumberType::Uint8;
        case 16: return NumberType::Uint16;
        case 32: return NumberType::Uint32;
        case 64: return NumberType::Uint64;
        default: return refused("its samples are unsigned integers");
        }
    case SAMPLEFORMAT_INT:
        switch (bits) {
        case 8: return NumberType::Int8;
        case 16: return NumberType::Int16;
        case 32: return NumberType::Int32;
        case 64: return NumberType::Int64;
        default: return refused("its samples are signed integers");
        }
    case SAMPLEFORMAT_IEEEFP:
        switch (bits) {
        case 16: return NumberType::Half;
        case 32: return NumberType::Float;
        case 64: return NumberType::Double;
        default: return refused("its samples are floats");
        }
    default: return refused("its samples are complex numbers");
    }
}

/// Everything of a page that has to do with where its numbers are.
Result<void> read_geometry(TIFF* tiff, Page& page) {
    page.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
    page.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
    page.samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    page.planar = page.samples > 1 && field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) ==
                                          PLANARCONFIG_SEPARATE;
    page.tiled = TIFFIsTiled(tiff) != 0;
    if (page.tiled) {
        page.block_width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
        page.block_height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
    } else {
        page.block_width = page.width;
        page.block_height =
            std::min(page.height, field<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, page.height));
    }
    if (page.width == 0 || page.height == 0 || page.samples == 0 || page.block_width == 0 ||
        page.block_height == 0)
        return fail(ErrorCode::Damaged, "has a page without pixels");
    if (page.width > image::kMostSidePixels || page.height > image::kMostSidePixels ||
        page.block_width > image::kMostSidePixels || page.block_height > image::kMostSidePixels)
        return fail(ErrorCode::Damaged, "has a page of " + std::to_string(page.width) + " by " +
                                            std::to_string(page.height) + " pixels");
    // Below 2^60 pixels of 2^19 bytes: divide, the product may not fit.
    const std::uint64_t pixel_bytes = std::uint64_t{page.samples} * image::number_bytes(page.type);
    if (std::uint64_t{page.width} * page.height > image::kMostPartBytes / pixel_bytes ||
        std::uint64_t{page.block_width} * page.block_height > image::kMostPartBytes / pixel_bytes)
        return fail(ErrorCode::Damaged,
                    "a page has more than " + std::to_string(image::kMostPartBytes) + " bytes");
    return {};
}

Result<void> read_packing(TIFF* tiff, Page& page) {
    const auto code = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    const auto* const found = std::find_if(kCompressions.begin(), kCompressions.end(),
                                           [code](const Compression& known) { return known.code == code; });
    if (found == kCompressions.end() || TIFFIsCODECConfigured(code) == 0)
        return fail(ErrorCode::Unsupported,
                    "its compression " +
                        (found == kCompressions.end() ? std::to_string(code) : std::string(found->word)) +
                        " is none that this libtiff unpacks to samples");
    page.compression = found->word;
    const auto photometric = field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    if (photometric != PHOTOMETRIC_MINISBLACK && photometric != PHOTOMETRIC_RGB)
        return fail(ErrorCode::Unsupported,
                    "its samples are no amounts of light (photometric interpretation " +
                        std::to_string(photometric) + "); expected 1, black is zero, or 2, RGB");
    page.plain = code == COMPRESSION_NONE && !page.tiled &&
                 field<std::uint16_t>(tiff, TIFFTAG_FILLORDER, FILLORDER_MSB2LSB) == FILLORDER_MSB2LSB;
    return {};
}

/// Refuses pages that a file of this size cannot hold, before anything of them is allocated.
Result<void> check_size(const Page& page, std::uint64_t file_bytes) {
    const std::uint64_t bytes =
        std::uint64_t{page.width} * page.height * page.samples * image::number_bytes(page.type);
    if (page.plain ? bytes <= file_bytes : bytes <= kSmallBytes || bytes / kMostRatio <= file_bytes)
        return {};
    return fail(ErrorCode::Damaged, "has " + std::to_string(file_bytes) + " bytes, and a page of " +
                                        std::to_string(bytes) + (page.plain ? "" : " unpacked"));
}

void read_alpha(TIFF* tiff, Page& page) {
    page.alpha.assign(page.samples, false);
    std::uint16_t count = 0;
    const std::uint16_t* kinds = nullptr;
    if (TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) != 1 || kinds == nullptr)
        return;
    for (std::uint16_t i = 0; i < std::min(count, page.samples); ++i)
        page.alpha[static_cast<std::size_t>(page.samples - count + i)] =
            kinds[i] == EXTRASAMPLE_ASSOCALPHA || kinds[i] == EXTRASAMPLE_UNASSALPHA;
}

}  // namespace

std::string Page::text(std::string_view name) const {
    const auto found =
        std::find_if(texts.begin(), texts.end(), [name](const auto& entry) { return entry.first == name; });
    return found == texts.end() ? std::string() : found->second;
}

std::uint64_t Page::block_bytes(std::uint64_t rows) const {
    return rows * block_width * (planar ? 1 : samples) * image::number_bytes(type);
}

bool is_reduced(const Handle& handle) {
    const auto kind = field<std::uint32_t>(handle.get(), TIFFTAG_SUBFILETYPE, 0);
    return (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0;
}

Result<Page> read_page(Handle& handle) {
    TIFF* const tiff = handle.get();
    Page page;
    page.directory = TIFFCurrentDirOffset(tiff);
    page.big_endian = TIFFIsBigEndian(tiff) != 0;
    OSIO_TRY(page.type, number_type(field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1),
                                    field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT)));
    OSIO_CHECK_OK(read_geometry(tiff, page));
    OSIO_CHECK_OK(read_packing(tiff, page));
    OSIO_CHECK_OK(check_size(page, handle.file().size()));
    read_alpha(tiff, page);
    for (const TextTag& text : kTextTags) {
        OSIO_TRY(std::string value, text_of(tiff, text.tag));
        if (!value.empty())
            page.texts.emplace_back(text.name, std::move(value));
    }
    OSIO_TRY(page.gdal_metadata, text_of(tiff, kGdalMetadata));
    OSIO_TRY(page.gdal_no_data, text_of(tiff, kGdalNoData));
    OSIO_TRY(page.xmp, text_of(tiff, TIFFTAG_XMLPACKET));
    return page;
}

}  // namespace osio::tiff
