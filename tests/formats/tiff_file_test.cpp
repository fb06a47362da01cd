// SPDX-License-Identifier: Apache-2.0
//
// Blocks of TIFF files that libtiff wrote against the obvious: one number at a time, by its pixel and sample.
#include <formats/files/text_file.h>
#include <formats/image/open_image.h>
#include <formats/tiff/gdal_metadata.h>
#include <formats/tiff/text_tags.h>
#include <formats/tiff/tiff_file.h>

#include <support/exr_files.h>
#include <support/samples.h>

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

namespace osio::tiff {
namespace {

using image::Grain;
using image::NumberType;
using image::PlaneChannels;
using test::TestFolder;

constexpr std::uint32_t kWidth = 37, kHeight = 53;
constexpr std::uint16_t kSamples = 5;

struct TestTiff {
    NumberType type = NumberType::Uint16;
    bool planar = false;
    std::uint32_t tile = 0;  ///< 0: strips
    std::uint32_t rows_per_strip = 8;
    const char* mode = "w";  ///< libtiff's: w8 BigTIFF, wb big-endian
    int compression = COMPRESSION_NONE;
    int predictor = PREDICTOR_NONE;
    std::uint16_t samples = kSamples;
    std::string metadata;  ///< tag 42112
    std::string no_data;   ///< tag 42113
    std::uint32_t pages = 1;
    bool described = false;  ///< pages by ImageDescription
};

std::string wavelength_items(std::size_t samples) {
    std::vector<GdalItem> items;
    for (std::size_t s = 0; s < samples; ++s) {
        items.push_back({"wavelength", std::to_string(400 + 50 * s), s, {}, {}});
        items.push_back({"wavelength_units", "nm", s, {}, {}});
    }
    return gdal_metadata_text(items);
}

/// Bytes of numbers by page, row, pixel, sample. No NaN among floats: what is compared is values.
std::vector<char> random_numbers(const TestTiff& file) {
    std::mt19937 random(7);
    std::vector<char> out(std::size_t{file.pages} * kWidth * kHeight * file.samples *
                          image::number_bytes(file.type));
    for (char& byte : out)
        byte = static_cast<char>(random() & 0x3f);
    return out;
}

std::uint16_t format_of(NumberType type) {
    switch (type) {
    case NumberType::Int8:
    case NumberType::Int16:
    case NumberType::Int32:
    case NumberType::Int64: return SAMPLEFORMAT_INT;
    case NumberType::Half:
    case NumberType::Float:
    case NumberType::Double: return SAMPLEFORMAT_IEEEFP;
    default: return SAMPLEFORMAT_UINT;
    }
}

/// The numbers of a box as a strip or tile stores them; 0 outside the image.
std::vector<char> box(const TestTiff& file, const std::vector<char>& numbers, std::uint32_t page,
                      std::uint32_t x0, std::uint32_t y0, std::uint32_t width, std::uint32_t height,
                      int only_sample) {
    const std::size_t bytes = image::number_bytes(file.type);
    std::vector<char> out;
    for (std::uint32_t y = y0; y < y0 + height; ++y)
        for (std::uint32_t x = x0; x < x0 + width; ++x)
            for (std::uint32_t s = 0; s < file.samples; ++s) {
                if (only_sample >= 0 && static_cast<std::uint32_t>(only_sample) != s)
                    continue;
                const std::size_t at =
                    (((std::size_t{page} * kHeight + y) * kWidth + x) * file.samples + s) * bytes;
                for (std::size_t i = 0; i < bytes; ++i)
                    out.push_back(x < kWidth && y < kHeight ? numbers[at + i] : '\0');
            }
    return out;
}

void write(const std::string& path, const TestTiff& file, const std::vector<char>& numbers) {
    TIFF* const tiff = TIFFOpen(path.c_str(), file.mode);
    ASSERT_NE(tiff, nullptr);
    static std::array<char, 16> metadata{"GDALMetadata"}, no_data{"GDALNoData"};
    const std::array<TIFFFieldInfo, 2> fields{
        {{kGdalMetadata, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, metadata.data()},
         {kGdalNoData, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, no_data.data()}}};
    for (std::uint32_t page = 0; page < file.pages; ++page) {
        TIFFMergeFieldInfo(tiff, fields.data(), fields.size());
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(file.samples));
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * image::number_bytes(file.type)));
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, static_cast<int>(format_of(file.type)));
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, file.planar ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, file.compression);
        if (file.predictor != PREDICTOR_NONE)
            TIFFSetField(tiff, TIFFTAG_PREDICTOR, file.predictor);
        if (!file.metadata.empty())
            TIFFSetField(tiff, kGdalMetadata, file.metadata.c_str());
        if (!file.no_data.empty())
            TIFFSetField(tiff, kGdalNoData, file.no_data.c_str());
        if (file.described)
            TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION,
                         ("band at " + std::to_string(400 + 50 * page) + " nm").c_str());
        const std::uint32_t width = file.tile > 0 ? file.tile : kWidth;
        const std::uint32_t height = file.tile > 0 ? file.tile : file.rows_per_strip;
        if (file.tile > 0) {
            TIFFSetField(tiff, TIFFTAG_TILEWIDTH, file.tile);
            TIFFSetField(tiff, TIFFTAG_TILELENGTH, file.tile);
        } else {
            TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, file.rows_per_strip);
        }
        std::uint32_t index = 0;
        for (int plane = file.planar ? 0 : -1; plane < (file.planar ? int{file.samples} : 0); ++plane)
            for (std::uint32_t y = 0; y < kHeight; y += height)
                for (std::uint32_t x = 0; x < kWidth; x += width) {
                    const std::uint32_t rows = file.tile > 0 ? height : std::min(height, kHeight - y);
                    auto bytes = box(file, numbers, page, x, y, width, rows, plane);
                    const auto size = static_cast<tmsize_t>(bytes.size());
                    EXPECT_EQ(file.tile > 0 ? TIFFWriteEncodedTile(tiff, index, bytes.data(), size)
                                            : TIFFWriteEncodedStrip(tiff, index, bytes.data(), size),
                              size);
                    ++index;
                }
        EXPECT_EQ(TIFFWriteDirectory(tiff), 1);
    }
    TIFFClose(tiff);
}

template <class T>
double number_at(const std::vector<char>& numbers, std::size_t index) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), numbers.data() + index * sizeof(T), sizeof(T));
    return static_cast<double>(std::bit_cast<T>(raw));
}

double number_at(NumberType type, const std::vector<char>& numbers, std::size_t index) {
    switch (type) {
    case NumberType::Uint8: return number_at<std::uint8_t>(numbers, index);
    case NumberType::Int8: return number_at<std::int8_t>(numbers, index);
    case NumberType::Uint16: return number_at<std::uint16_t>(numbers, index);
    case NumberType::Int16: return number_at<std::int16_t>(numbers, index);
    case NumberType::Uint32: return number_at<std::uint32_t>(numbers, index);
    case NumberType::Int32: return number_at<std::int32_t>(numbers, index);
    case NumberType::Uint64: return number_at<std::uint64_t>(numbers, index);
    case NumberType::Int64: return number_at<std::int64_t>(numbers, index);
    case NumberType::Half: {
        Imath::half half;
        half.setBits(static_cast<std::uint16_t>(number_at<std::uint16_t>(numbers, index)));
        return static_cast<double>(static_cast<float>(half));
    }
    case NumberType::Float: return number_at<float>(numbers, index);
    case NumberType::Double: break;
    }
    return number_at<double>(numbers, index);
}

/// What a sample is by the file's metadata.
using Meaning = double (*)(double number, std::size_t sample);

double itself(double number, std::size_t) {
    return number;
}

void expect_numbers(const std::string& path, const TestTiff& written, const std::vector<char>& numbers,
                    const PlaneChannels& planes, Grain grain, Meaning meaning = itself) {
    const auto file = image::open_image(path);
    ASSERT_TRUE(file) << file.error().text();
    const auto expected = [&](std::size_t plane, std::size_t x, std::size_t y) {
        const std::size_t page = written.pages > 1 ? *planes[plane] : 0;
        const std::size_t sample = written.pages > 1 ? 0 : *planes[plane];
        const std::size_t at = ((page * kHeight + y) * kWidth + x) * written.samples + sample;
        return static_cast<float>(meaning(number_at(written.type, numbers, at), sample));
    };
    test::expect_samples(**file, planes, grain, expected,
                         std::string(image::number_name(written.type)) + " packed by " +
                             std::to_string(written.compression) + " in " + written.mode);
}

void expect_numbers(const TestTiff& written, Meaning meaning = itself) {
    const TestFolder folder;
    const auto numbers = random_numbers(written);
    write(folder.path("cube.tif"), written, numbers);
    for (const PlaneChannels& planes :
         {PlaneChannels{0U, 1U, 2U, 3U, 4U}, PlaneChannels{4U, {}, 1U}, PlaneChannels{2U}})
        for (const Grain grain : {Grain::Block, Grain::Chunk})
            expect_numbers(folder.path("cube.tif"), written, numbers, planes, grain, meaning);
}

TEST(TiffFile, EveryTypeOrderPlaneStripAndTileIsReadAsWritten) {
    TestTiff file;
    file.metadata = wavelength_items(kSamples);
    for (file.type = NumberType::Uint8;;
         file.type = static_cast<NumberType>(static_cast<int>(file.type) + 1)) {
        for (const char* mode : {"wl", "wb", "w8l", "w8b"})
            for (const bool planar : {false, true})
                for (const std::uint32_t tile : {0U, 16U}) {
                    file.mode = mode;
                    file.planar = planar;
                    file.tile = tile;
                    expect_numbers(file);
                }
        if (file.type == NumberType::Double)
            break;
    }
}

TEST(TiffFile, EveryPackingIsReadAsWritten) {
    struct Packing {
        int compression, predictor;
        NumberType type;
    };

    TestTiff file;
    file.metadata = wavelength_items(kSamples);
    // In the other byte order libtiff 4.5 swaps floats before predictor 3 when it writes, and rightly not after when
    // it reads: such files are made here in the machine's order only.
    for (const Packing& packing :
         {Packing{COMPRESSION_LZW, PREDICTOR_HORIZONTAL, NumberType::Uint16},
          Packing{COMPRESSION_LZW, PREDICTOR_FLOATINGPOINT, NumberType::Double},
          Packing{COMPRESSION_ADOBE_DEFLATE, PREDICTOR_FLOATINGPOINT, NumberType::Float},
          Packing{COMPRESSION_ADOBE_DEFLATE, PREDICTOR_HORIZONTAL, NumberType::Uint32},
          Packing{COMPRESSION_PACKBITS, PREDICTOR_NONE, NumberType::Int16},
          Packing{COMPRESSION_LZMA, PREDICTOR_NONE, NumberType::Half},
          Packing{COMPRESSION_ZSTD, PREDICTOR_HORIZONTAL, NumberType::Uint8},
          Packing{COMPRESSION_LERC, PREDICTOR_NONE, NumberType::Float}})
        for (const char* mode : {"wl", "w8b"})
            for (const bool planar : {false, true})
                for (const std::uint32_t tile : {0U, 32U}) {
                    if (packing.predictor == PREDICTOR_FLOATINGPOINT && std::string_view(mode) != "wl")
                        continue;
                    file.compression = packing.compression;
                    file.predictor = packing.predictor;
                    file.type = packing.type;
                    file.mode = mode;
                    file.planar = planar;
                    file.tile = tile;
                    expect_numbers(file);
                }
}

TEST(TiffFile, StripsOfAnyHeightAreReadAsWritten) {
    TestTiff file;
    file.metadata = wavelength_items(kSamples);
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW})
        for (const std::uint32_t rows : {1U, 7U, 52U, 53U, 100U})
            for (const bool planar : {false, true}) {
                file.compression = compression;
                file.rows_per_strip = rows;
                file.planar = planar;
                expect_numbers(file);
            }
}

TEST(TiffFile, PagesOfOneSampleAreBandsOfOneImage) {
    TestTiff file;
    file.samples = 1;
    file.pages = 5;
    file.described = true;
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW}) {
        file.compression = compression;
        expect_numbers(file);
    }
    const TestFolder folder;
    write(folder.path("cube.tif"), file, random_numbers(file));
    const auto opened = image::open_image(folder.path("cube.tif")).value();
    ASSERT_EQ(opened->parts().size(), 1U);
    EXPECT_EQ(opened->parts()[0].layout.channel_names,
              (std::vector<std::string>{"T.400nm", "T.450nm", "T.500nm", "T.550nm", "T.600nm"}));
    EXPECT_EQ(opened->parts()[0].storage, "5 pages, strips of uint16, little-endian");
}

TEST(TiffFile, NumbersAreScaledAsTheMetadataSay) {
    TestTiff file;
    auto items = parse_gdal_metadata(wavelength_items(kSamples)).value();
    items.push_back({"SCALE", "0.1", 4, {}, "scale"});
    items.push_back({"OFFSET", "0.3", 4, {}, "offset"});
    items.push_back({"OFFSET", "-7", 2, {}, "offset"});
    file.metadata = gdal_metadata_text(items);
    file.no_data = "257";
    expect_numbers(file, [](double number, std::size_t sample) {
        constexpr std::array<double, 5> kGain{1, 1, 1, 1, 0.1}, kAdd{0, 0, -7, 0, 0.3};
        return number == 257 ? std::nan("") : number * kGain[sample] + kAdd[sample];
    });
}

TEST(TiffFile, ATruncatedFileIsRefusedWhereverItEnds) {
    const TestFolder folder;
    TestTiff file;
    file.metadata = wavelength_items(kSamples);
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE}) {
        file.compression = compression;
        write(folder.path("whole.tif"), file, random_numbers(file));
        const std::string bytes = files::read_text(folder.path("whole.tif")).value();
        for (std::size_t size = 4; size < bytes.size();
             size += size < 64 || size + 900 > bytes.size() ? 1U : 997U) {
            std::ofstream(folder.path("cut.tif"), std::ios::binary) << bytes.substr(0, size);
            const auto opened = image::open_image(folder.path("cut.tif"));
            ASSERT_FALSE(opened) << size << " of " << bytes.size();
            ASSERT_TRUE(opened.error().code == ErrorCode::Damaged) << opened.error().text();
        }
    }
}

/// Opens and reads everything; no more is asked of damaged files than that they end in a value or an error.
void read_all(const std::string& path) {
    const auto file = image::open_image(path);
    if (!file)
        return;
    for (std::size_t part = 0; part < (*file)->parts().size(); ++part) {
        PlaneChannels planes;
        for (std::size_t channel = 0; channel < (*file)->parts()[part].channels.size(); ++channel)
            planes.emplace_back(channel);
        const auto source = (*file)->make_block_source(part, planes, Grain::Block);
        if (!source)
            continue;
        const auto reader = (*source)->start_reader();
        for (std::size_t block = 0; reader && block < std::min<std::size_t>((*source)->block_count(), 64);
             ++block)
            if (!(*reader)->read(block))
                break;
    }
}

TEST(TiffFile, AFileWithWrongBitsEndsInAnErrorOrInNumbers) {
    const TestFolder folder;
    TestTiff file;
    file.metadata = wavelength_items(kSamples);
    std::mt19937 random(3);
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_LERC})
        for (const std::uint32_t tile : {0U, 16U}) {
            file.compression = compression;
            file.tile = tile;
            file.type = NumberType::Float;
            write(folder.path("whole.tif"), file, random_numbers(file));
            const std::string bytes = files::read_text(folder.path("whole.tif")).value();
            for (int i = 0; i < 150; ++i) {
                std::string damaged = bytes;
                // Half of the damage where the directory is, at the end.
                const std::size_t from = i % 2 == 0 ? 0 : bytes.size() - 1500;
                damaged[from + random() % (bytes.size() - from)] ^= static_cast<char>(1U << (random() % 8));
                std::ofstream(folder.path("damaged.tif"), std::ios::binary) << damaged;
                read_all(folder.path("damaged.tif"));
            }
        }
}

TEST(TiffFile, WhatIsNotSpectralIsRefusedWithWords) {
    const TestFolder folder;
    const auto refused = [&folder](ErrorCode code, const std::string& words) {
        const auto file = image::open_image(folder.path("a.tif"));
        ASSERT_FALSE(file);
        EXPECT_EQ(file.error().code, code) << file.error().text();
        EXPECT_NE(file.error().text().find(words), std::string::npos) << file.error().text();
    };
    TestTiff file;
    file.samples = 3;
    write(folder.path("a.tif"), file, random_numbers(file));
    refused(ErrorCode::NotSpectral, "1 page with 3 samples a pixel, none of which has a wavelength");
    file.samples = 1;
    file.pages = 2;
    write(folder.path("a.tif"), file, random_numbers(file));
    refused(ErrorCode::NotSpectral, "2 pages with 1 sample a pixel");
    file = {};
    file.metadata = "<GDALMetadata><Item name='wavelength' sample='0'>400</Item>";
    write(folder.path("a.tif"), file, random_numbers(file));
    refused(ErrorCode::Damaged, "GDAL metadata (tag 42112) are no XML");
    file.metadata = "<GDALMetadata><Item name='wavelength'>400,500,600</Item></GDALMetadata>";
    write(folder.path("a.tif"), file, random_numbers(file));
    refused(ErrorCode::Damaged, "found 3 items of \"wavelength\" of its GDAL metadata for 5 samples");
    file.metadata = "<GDALMetadata><Item name='wavelength' sample='0'>blue</Item></GDALMetadata>";
    write(folder.path("a.tif"), file, random_numbers(file));
    refused(ErrorCode::Damaged, "found \"blue\" in \"wavelength\"");
}

}  // namespace
}  // namespace osio::tiff
