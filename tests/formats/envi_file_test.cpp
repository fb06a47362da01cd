// SPDX-License-Identifier: Apache-2.0
//
// Blocks of ENVI files against the obvious: one number at a time, by its index.
#include <formats/envi/envi_file.h>
#include <formats/image/open_image.h>

#include <support/exr_files.h>
#include <support/samples.h>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

namespace osio::envi {
namespace {

using image::Grain;
using image::PlaneChannels;
using test::TestFolder;

constexpr std::uint64_t kSamples = 7, kLines = 150, kBands = 5, kOffset = 13;

void write(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string header_text(int type, const std::string& interleave, int order, const std::string& more = {}) {
    return "ENVI\nsamples = 7\nlines = 150\nbands = 5\nheader offset = 13\ndata type = " +
           std::to_string(type) + "\ninterleave = " + interleave + "\nbyte order = " + std::to_string(order) +
           "\nwavelength units = nm\nwavelength = {400, 450.5, 500, 550, 600}\n" + more;
}

/// Bytes that are numbers of any type. No NaN among floats: what is compared is values.
std::string random_bytes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::string out(count, '\0');
    for (char& byte : out)
        byte = static_cast<char>(random() & 0x3f);
    return out;
}

/// The number at a place in the file: the obvious reading of ENVI's definition.
template <class T>
double number_at(const std::string& bytes, Interleave interleave, bool big, std::uint64_t x, std::uint64_t y,
                 std::uint64_t band) {
    std::uint64_t index = 0;
    switch (interleave) {
    case Interleave::Bsq: index = (band * kLines + y) * kSamples + x; break;
    case Interleave::Bil: index = (y * kBands + band) * kSamples + x; break;
    case Interleave::Bip: index = (y * kSamples + x) * kBands + band; break;
    }
    std::array<char, sizeof(T)> raw{};
    for (std::size_t i = 0; i < sizeof(T); ++i)
        raw[big ? sizeof(T) - 1 - i : i] = bytes[kOffset + index * sizeof(T) + i];
    return static_cast<double>(std::bit_cast<T>(raw));
}

double number_at(DataType type, const std::string& bytes, Interleave interleave, bool big, std::uint64_t x,
                 std::uint64_t y, std::uint64_t band) {
    switch (type) {
    case DataType::Uint8: return number_at<std::uint8_t>(bytes, interleave, big, x, y, band);
    case DataType::Int16: return number_at<std::int16_t>(bytes, interleave, big, x, y, band);
    case DataType::Int32: return number_at<std::int32_t>(bytes, interleave, big, x, y, band);
    case DataType::Float: return number_at<float>(bytes, interleave, big, x, y, band);
    case DataType::Double: return number_at<double>(bytes, interleave, big, x, y, band);
    case DataType::Uint16: return number_at<std::uint16_t>(bytes, interleave, big, x, y, band);
    case DataType::Uint32: return number_at<std::uint32_t>(bytes, interleave, big, x, y, band);
    case DataType::Int64: return number_at<std::int64_t>(bytes, interleave, big, x, y, band);
    case DataType::Uint64: return number_at<std::uint64_t>(bytes, interleave, big, x, y, band);
    }
    return 0;
}

/// What a sample is by the keys of a header, in the order in which they apply.
using Meaning = double (*)(double number, std::uint64_t band);

void expect_numbers(const std::string& path, const std::string& bytes, const PlaneChannels& planes,
                    Grain grain, Meaning meaning) {
    const auto file = EnviFile::open(path).value();
    const EnviHeader& header = file->header();
    const auto expected = [&](std::size_t plane, std::size_t x, std::size_t y) {
        const std::size_t band = *planes[plane];
        return static_cast<float>(
            meaning(number_at(header.type, bytes, header.interleave, header.big_endian, x, y, band), band));
    };
    test::expect_samples(*file, planes, grain, expected,
                         std::string(image::number_name(number_type(header.type))) + " " +
                             std::string(interleave_name(header.interleave)));
}

const std::vector<PlaneChannels> kChoices{{0U, 1U, 2U, 3U, 4U}, {4U, {}, 1U}, {2U}};
constexpr std::array<DataType, 9> kTypes{DataType::Uint8,  DataType::Int16,  DataType::Int32,
                                         DataType::Float,  DataType::Double, DataType::Uint16,
                                         DataType::Uint32, DataType::Int64,  DataType::Uint64};

TEST(EnviFile, EveryTypeOrderAndInterleaveIsReadAsDefined) {
    const TestFolder folder;
    for (const DataType type : kTypes)
        for (const std::string interleave : {"bsq", "bil", "bip"})
            for (const int order : {0, 1}) {
                const std::string bytes = random_bytes(
                    kOffset + kSamples * kLines * kBands * data_bytes(type), 1 + static_cast<unsigned>(type));
                write(folder.path("cube.hdr"), header_text(static_cast<int>(type), interleave, order));
                write(folder.path("cube.img"), bytes);
                for (const PlaneChannels& planes : kChoices)
                    for (const Grain grain : {Grain::Block, Grain::Chunk})
                        expect_numbers(folder.path("cube.hdr"), bytes, planes, grain,
                                       [](double number, std::uint64_t) { return number; });
            }
}

TEST(EnviFile, NumbersAreScaledAsTheHeaderSays) {
    const TestFolder folder;
    const std::string bytes = random_bytes(kOffset + kSamples * kLines * kBands * 2, 7);
    write(folder.path("cube.dat"), bytes);
    write(folder.path("cube.hdr"),
          header_text(12, "bip", 0,
                      "data gain values = {1, 2, 3, 4, 0.1}\ndata offset values = {0, 0, -7, 0, 0.3}\n"
                      "reflectance scale factor = 10000\ndata ignore value = 257\n"));
    expect_numbers(folder.path("cube.hdr"), bytes, kChoices[0], Grain::Block,
                   [](double number, std::uint64_t band) {
                       constexpr std::array<double, 5> kGain{1, 2, 3, 4, 0.1}, kAdd{0, 0, -7, 0, 0.3};
                       return number == 257 ? std::nan("") : (number * kGain[band] + kAdd[band]) / 10000;
                   });
}

TEST(EnviFile, DoublesBeyondAFloatBecomeInfinite) {
    const TestFolder folder;
    const std::array<double, 4> numbers{1e39, -1e300, 3.4028234663852886e38, 3.4028235e38};
    write(folder.path("cube.hdr"),
          "ENVI\nsamples = 4\nlines = 1\nbands = 1\ndata type = 5\ninterleave = bsq\n");
    write(folder.path("cube"), {reinterpret_cast<const char*>(numbers.data()), sizeof numbers});
    const auto file = EnviFile::open(folder.path("cube.hdr")).value();
    const auto source = file->make_block_source(0, {0U}, Grain::Block).value();
    const auto reader = source->start_reader().value();
    std::array<float, 4> found{};
    std::memcpy(found.data(), reader->read(0).value().planes[0].data, sizeof found);
    const float most = std::numeric_limits<float>::max(), infinite = std::numeric_limits<float>::infinity();
    EXPECT_EQ(found, (std::array<float, 4>{infinite, -infinite, most, most}));
}

TEST(EnviFile, ChannelsAreNamedByTheLayout) {
    const TestFolder folder;
    write(folder.path("cube.bil"), random_bytes(kOffset + kSamples * kLines * kBands * 2, 7));
    write(folder.path("cube.hdr"), header_text(2, "bil", 0,
                                               "bbl = {1,1,0,1,1}\nfwhm = {5,5,5,6,7}\n"
                                               "data units = Radiance\nsensor type = AVIRIS\n"));
    const auto file = image::open_image(folder.path("cube.hdr")).value();
    EXPECT_EQ(file->format(), "ENVI");
    const image::Part& part = file->parts()[0];
    EXPECT_EQ(part.layout.channel_names,
              (std::vector<std::string>{"S0.400nm", "S0.450,5nm", "bad.3", "S0.550nm", "S0.600nm"}));
    ASSERT_EQ(part.layout.sets.size(), 1U);
    EXPECT_EQ(part.layout.sets[0].bands.size(), 4U);
    EXPECT_EQ(part.storage, "bil of int16, little-endian");
    ASSERT_TRUE(part.metadata.fwhm);
    EXPECT_EQ(part.metadata.fwhm->values, (std::vector<double>{5, 5, 5, 6, 7}));
    EXPECT_EQ(image::text_attributes(part.header).at("envi:sensor type"), "AVIRIS");
    EXPECT_EQ(part.metadata.emissive_units, std::string(kWrittenEmissiveUnits));
}

TEST(EnviFile, TheDataFileIsFoundBesideTheHeader) {
    const std::string bytes = random_bytes(kOffset + kSamples * kLines * kBands, 7);
    const auto opens = [&bytes](const std::string& header, const std::string& data, const std::string& by) {
        const TestFolder folder;
        write(folder.path(header), header_text(1, "bsq", 0));
        write(folder.path(data), bytes);
        const auto file = image::open_image(folder.path(by));
        EXPECT_TRUE(file) << file.error().text();
        return file && file.value()->format() == "ENVI";
    };
    for (const std::string data :
         {"cube", "cube.img", "cube.dat", "cube.raw", "cube.bsq", "cube.bin", "cube.IMG"}) {
        EXPECT_TRUE(opens("cube.hdr", data, "cube.hdr")) << data;
        EXPECT_TRUE(opens("cube.hdr", data, data)) << data;
    }
    EXPECT_TRUE(opens("cube.dat.hdr", "cube.dat", "cube.dat.hdr"));
    EXPECT_TRUE(opens("cube.dat.hdr", "cube.dat", "cube.dat"));
    EXPECT_TRUE(opens("CUBE.HDR", "CUBE.DAT", "CUBE.HDR"));
}

TEST(EnviFile, WhatCannotBeReadIsRefusedBeforeAnythingIsAllocated) {
    const TestFolder folder;
    const auto refused = [&folder](ErrorCode code, const std::string& words) {
        const auto file = image::open_image(folder.path("cube.hdr"));
        ASSERT_FALSE(file);
        EXPECT_EQ(file.error().code, code) << file.error().text();
        EXPECT_NE(file.error().text().find(words), std::string::npos) << file.error().text();
    };
    write(folder.path("cube.hdr"), header_text(1, "bsq", 0));
    refused(ErrorCode::Damaged, "no data file beside the header");
    const std::size_t whole = kOffset + kSamples * kLines * kBands;
    write(folder.path("cube.img"), random_bytes(whole - 1, 7));
    refused(ErrorCode::Damaged, "has 5262 bytes, the header promises 5263");
    write(folder.path("cube.img"), random_bytes(whole, 7));
    EXPECT_TRUE(image::open_image(folder.path("cube.hdr")));
    write(folder.path("cube.hdr"),
          "ENVI\nsamples = 1000000000\nlines = 1000\nbands = 1\ndata type = 5\ninterleave = bsq\n");
    refused(ErrorCode::Damaged, "the header promises 8000000000000");
    write(folder.path("cube.hdr"), "ENVI\nsamples = 1\n");
    refused(ErrorCode::Damaged, "lacks \"lines\"");
}

TEST(EnviFile, AFileThatShrinksWhileItIsReadIsAnError) {
    const TestFolder folder;
    write(folder.path("cube.hdr"), header_text(1, "bip", 0));
    write(folder.path("cube.img"), random_bytes(kOffset + kSamples * kLines * kBands, 7));
    const auto file = EnviFile::open(folder.path("cube.hdr")).value();
    const auto source = file->make_block_source(0, {0U}, Grain::Chunk).value();
    const auto reader = source->start_reader().value();
    EXPECT_TRUE(reader->read(kLines - 1));
    write(folder.path("cube.img"), random_bytes(kOffset + kSamples * kBands, 7));
    EXPECT_TRUE(reader->read(0));
    const auto lost = reader->read(kLines - 1);
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().code, ErrorCode::Damaged);
    EXPECT_EQ(lost.error().where, folder.path("cube.img"));
}

}  // namespace
}  // namespace osio::envi
