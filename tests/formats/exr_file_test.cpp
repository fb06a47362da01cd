// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/block_source.h>
#include <formats/exr/exr_file.h>

#include <support/exr_files.h>

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sys/stat.h>

namespace osio::exr {
namespace {

using test::band_channels;
using test::TestFolder;
using test::TestPart;
using test::write_exr;

TEST(ExrFile, HeadersAreUnderstood) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    TestPart part{band_channels("T", 400, 10, 700, Imf::HALF)};
    part.channels.push_back({"A", Imf::FLOAT});
    part.channels.push_back({"id", Imf::UINT});
    part.data_window = {{-3, 5}, {10, 20}};
    part.display_window = Imath::Box2i({0, 0}, {99, 49});
    part.compression = Imf::PIZ_COMPRESSION;
    part.tiles = Imath::V2i(8, 4);
    part.attributes = [](Imf::Header& header) {
        header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
    };
    write_exr(path, {part});
    const auto file = ExrFile::open(path);
    ASSERT_TRUE(file) << file.error().text();
    ASSERT_EQ((*file)->parts().size(), 1U);
    const image::Part& read = (*file)->parts()[0];
    EXPECT_EQ(read.data_window, (Window{-3, 5, 10, 20}));
    EXPECT_EQ(read.display_window, (Window{0, 0, 99, 49}));
    EXPECT_EQ(read.channels.size(), 33U);
    EXPECT_TRUE(read.tiled);
    EXPECT_FALSE(read.deep);
    EXPECT_EQ(read.compression, "piz");
    EXPECT_EQ(read.metadata.layout_version, "1.0");
    ASSERT_EQ(read.layout.sets.size(), 1U);
    EXPECT_EQ(read.layout.sets[0].bands.size(), 31U);
    for (const image::Channel& channel : read.channels)
        EXPECT_EQ(channel.type, channel.name == "A"    ? SampleType::Float
                                : channel.name == "id" ? SampleType::Uint
                                                       : SampleType::Half);
}

TEST(ExrFile, PartsDeepAndSubsampledAreTold) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    const Imath::Box2i display({0, 0}, {99, 99});
    TestPart beauty{{{"R"}, {"G"}, {"B"}}};
    beauty.name = "beauty";
    beauty.display_window = display;
    TestPart bands{band_channels("S0", 400, 100, 700)};
    bands.name = "bands";
    bands.channels.push_back({"BY", Imf::HALF, 2});
    bands.data_window = {{0, 0}, {31, 31}};
    bands.display_window = display;
    TestPart deep{{{"Z"}}};
    deep.name = "deep";
    deep.deep = true;
    deep.display_window = display;
    deep.compression = Imf::ZIPS_COMPRESSION;
    write_exr(path, {beauty, bands, deep});
    const auto opened = ExrFile::open(path);
    ASSERT_TRUE(opened) << opened.error().text();
    const auto& file = *opened;
    ASSERT_EQ(file->parts().size(), 3U);
    EXPECT_EQ(file->parts()[1].name, "bands");
    EXPECT_TRUE(file->parts()[2].deep);
    EXPECT_TRUE(file->parts()[1].channels[0].subsampled);  // BY comes first
    EXPECT_FALSE(file->parts()[1].channels[1].subsampled);
    EXPECT_TRUE(file->parts()[0].layout.sets.empty());
}

ErrorCode code_of(const std::string& path) {
    const auto file = ExrFile::open(path);
    EXPECT_FALSE(file) << path;
    return file ? ErrorCode::Cancelled : file.error().code;
}

TEST(ExrFile, WhatIsNoReadableExrIsRefusedByItsKind) {
    const TestFolder folder;
    EXPECT_EQ(code_of(folder.path("missing.exr")), ErrorCode::Io);
    EXPECT_EQ(code_of(folder.path("")), ErrorCode::Io);  // a folder
    std::ofstream(folder.path("text.exr")) << "This is not an image at all, only text.";
    EXPECT_EQ(code_of(folder.path("text.exr")), ErrorCode::NotSpectral);
    std::ofstream(folder.path("empty.exr")).flush();
    EXPECT_EQ(code_of(folder.path("empty.exr")), ErrorCode::NotSpectral);
    std::ofstream(folder.path("magic.exr"), std::ios::binary) << "\x76\x2f\x31\x01";
    EXPECT_EQ(code_of(folder.path("magic.exr")), ErrorCode::Damaged);
}

/// A header may be whole where the table of chunks behind it is cut; then no pixel can be read.
TEST(ExrFile, EveryTruncationOfAHeaderOrItsTableIsRefused) {
    const TestFolder folder;
    const std::string path = folder.path("whole.exr");
    write_exr(path, {TestPart{band_channels("T", 400, 50, 700)}});
    std::ifstream in(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const std::string cut = folder.path("cut.exr");
    for (std::size_t length = 0; length < 900; length += 7) {
        std::ofstream(cut, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(length));
        const auto file = ExrFile::open(cut);
        if (!file)
            continue;
        const auto source = make_block_source(*file, 0, {0U}).value();
        const auto reader = source->start_reader();
        EXPECT_TRUE(!reader || !(*reader)->read(0)) << length << " bytes were enough";
    }
}

TEST(ExrFile, ASmallFileCannotAskForMuch) {
    const TestFolder folder;
    const std::string path = folder.path("huge.exr");
    TestPart part{{{"T.500nm"}}};
    part.compression = Imf::NO_COMPRESSION;
    part.data_window = {{0, 0}, {3, 3}};
    write_exr(path, {part});
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    // Stretch the data window to 2^30 rows: more chunks than the file has bytes.
    const auto at = bytes.find("dataWindow");
    ASSERT_NE(at, std::string::npos);
    const std::size_t max_y = at + sizeof("dataWindow") + sizeof("box2i") + 4 + 12;
    bytes[max_y + 3] = 0x40;
    std::ofstream(path, std::ios::binary) << bytes;
    const auto file = ExrFile::open(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::Damaged);
}

TEST(ExrFile, CompressionWordsAreThoseOfTheHost) {
    for (const char* word : {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"})
        EXPECT_EQ(compression_name(find_compression(word).value()), word);
    EXPECT_EQ(find_compression("ZIP").value(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(find_compression("zpi").error().text(),
              "no compression is called \"zpi\"; did you mean \"zip\"?");
}

}  // namespace
}  // namespace osio::exr
