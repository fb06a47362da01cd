// SPDX-License-Identifier: Apache-2.0
//
// Blocks of both readers against OpenEXR's C++ API reading the whole frame.
#include <formats/exr/block_source.h>

#include <support/exr_files.h>

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <thread>

namespace osio::exr {
namespace {

using test::band_channels;
using test::TestChannel;
using test::TestFolder;
using test::TestPart;
using test::write_exr;

/// Every plane of every block, read from the last to the first, against the whole frame.
void expect_same_as_openexr(const std::string& path, std::size_t part, const PlaneChannels& planes) {
    const auto file = ExrFile::open(path).value();
    const auto source = make_block_source(file, part, planes);
    ASSERT_TRUE(source) << source.error().text();
    const auto reader = (*source)->start_reader();
    ASSERT_TRUE(reader) << reader.error().text();
    const image::Part& header = file->parts()[part];
    std::vector<std::vector<char>> expected;
    for (const auto channel : planes)
        expected.push_back(
            channel ? test::read_with_openexr(path, static_cast<int>(part), header.channels[*channel].name)
                    : std::vector<char>());
    int rows = 0;
    const std::size_t count = (*source)->block_count();
    for (std::size_t index = count; index-- > 0;) {
        const auto block = (*reader)->read(index);
        ASSERT_TRUE(block) << block.error().text();
        const RowRange range = (*source)->rows_of_block(index);
        EXPECT_EQ(block->first_row, range.first);
        EXPECT_EQ(block->row_count, range.last - range.first + 1);
        EXPECT_EQ((*source)->block_of_row(range.first), index);
        EXPECT_EQ((*source)->block_of_row(range.last), index);
        rows += block->row_count;
        for (std::size_t p = 0; p < planes.size(); ++p) {
            if (!planes[p]) {
                EXPECT_EQ(block->planes[p].data, nullptr);
                continue;
            }
            const auto width = static_cast<std::size_t>(header.data_window.width());
            const std::size_t skip = static_cast<std::size_t>(range.first - header.data_window.min_y) * width;
            std::size_t next = 0;
            block->for_each_run([&](std::size_t first, std::size_t length, std::span<const BandView> views) {
                const std::size_t bytes = sample_bytes(views[p].type);
                EXPECT_EQ(first, next);
                EXPECT_EQ(
                    std::memcmp(views[p].data, expected[p].data() + (skip + first) * bytes, length * bytes),
                    0)
                    << "block " << index << " plane " << p;
                next += length;
            });
            EXPECT_EQ(next, static_cast<std::size_t>(block->row_count) * width);
        }
    }
    EXPECT_EQ(rows, header.data_window.height());
}

PlaneChannels all_of(std::size_t count) {
    PlaneChannels out;
    for (std::size_t c = 0; c < count; ++c)
        out.emplace_back(c);
    return out;
}

/// All, one, every second backwards with a gap.
std::vector<PlaneChannels> choices(std::size_t count) {
    PlaneChannels some;
    for (std::size_t c = count; c-- > 0;)
        if (c % 2 == 0)
            some.emplace_back(c);
    some.emplace_back(std::nullopt);
    return {all_of(count), {count - 1}, some};
}

const std::vector<Imf::Compression> kCompressions{
    Imf::NO_COMPRESSION,   Imf::RLE_COMPRESSION,   Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
    Imf::PIZ_COMPRESSION,  Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,  Imf::B44A_COMPRESSION,
    Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION};

class EveryCompression : public testing::TestWithParam<Imf::Compression> {};

TEST_P(EveryCompression, BlocksAreThePixelsOfTheFile) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    std::vector<std::vector<TestChannel>> sets{
        {{"T.500nm", Imf::HALF}},
        {{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}},
        {{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"A", Imf::HALF}},
        {{"T.400nm", Imf::FLOAT}, {"T.500nm", Imf::FLOAT}, {"T.600nm", Imf::FLOAT}},
        {{"A", Imf::FLOAT},
         {"T.400nm", Imf::HALF},
         {"T.500nm", Imf::UINT},
         {"T.600nm", Imf::FLOAT},
         {"Z", Imf::FLOAT}},
        band_channels("S0", 400, 10, 700, Imf::HALF)};
    for (const auto& channels : sets)
        for (const bool tiled : {false, true})
            for (const auto& window : {Imath::Box2i({0, 0}, {36, 52}), Imath::Box2i({-7, -11}, {20, 289}),
                                       Imath::Box2i({5, 100}, {5, 100})}) {
                TestPart part{channels};
                part.compression = GetParam();
                part.data_window = window;
                if (tiled)
                    part.tiles = Imath::V2i(16, 8);
                write_exr(path, {part});
                for (const auto& planes : choices(channels.size()))
                    expect_same_as_openexr(path, 0, planes);
            }
}

TEST_P(EveryCompression, NoiseThatDoesNotCompressIsReadToo) {
    const TestFolder folder;
    const std::string path = folder.path("noise.exr");
    TestPart part{band_channels("T", 400, 25, 700, Imf::FLOAT)};
    part.compression = GetParam();
    part.pattern = [state = std::uint32_t{1}](std::size_t, int, int) mutable {
        state = state * 1664525 + 1013904223;
        return static_cast<double>(state) / 4e9;
    };
    write_exr(path, {part});
    expect_same_as_openexr(path, 0, all_of(13));
}

TEST_P(EveryCompression, EveryKindOfHalfIsReadToo) {
    const TestFolder folder;
    const std::string path = folder.path("halves.exr");
    TestPart part{band_channels("T", 400, 50, 700, Imf::HALF)};
    part.compression = GetParam();
    part.data_window = {{0, 0}, {45, 66}};
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> values{0,    -0.0,  1,        -1,        65504,       -65504,
                                     6e-8, -6e-5, infinity, -infinity, std::nan("")};
    part.pattern = [&](std::size_t c, int x, int y) {
        const auto run = static_cast<std::size_t>(x / 9 + y / 9);  // flat blocks too
        return values[(c + run * (y % 2 == 0 ? 3 : 1)) % values.size()];
    };
    for (const bool perceptual : {false, true}) {
        part.channels[3].perceptual = perceptual;
        for (const bool tiled : {false, true}) {
            part.tiles = tiled ? std::optional(Imath::V2i(13, 7)) : std::nullopt;
            write_exr(path, {part});
            expect_same_as_openexr(path, 0, all_of(7));
        }
    }
}

TEST_P(EveryCompression, LineOrderLevelsAndPartsDoNotMatter) {
    const TestFolder folder;
    const std::string path = folder.path("parts.exr");
    TestPart first{{{"R"}, {"G"}, {"B"}}};
    first.name = "rgb";
    TestPart down{band_channels("T", 400, 50, 700, Imf::HALF)};
    down.name = "down";
    down.line_order = Imf::DECREASING_Y;
    TestPart tiles{band_channels("S0", 400, 50, 700)};
    tiles.name = "tiles";
    tiles.tiles = Imath::V2i(10, 10);
    tiles.mipmaps = true;
    tiles.line_order = Imf::RANDOM_Y;
    for (TestPart* part : {&first, &down, &tiles})
        part->compression = GetParam();
    write_exr(path, {first, down, tiles});
    expect_same_as_openexr(path, 0, all_of(3));
    expect_same_as_openexr(path, 1, all_of(7));
    expect_same_as_openexr(path, 2, all_of(7));
}

INSTANTIATE_TEST_SUITE_P(Exr, EveryCompression, testing::ValuesIn(kCompressions),
                         [](const auto& test) { return compression_name(test.param); });

TEST(BlockSource, SubsampledNeighboursAreSteppedOver) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    TestPart part{band_channels("T", 400, 100, 700)};
    part.channels.push_back({"BY", Imf::HALF, 2});
    part.data_window = {{0, 0}, {37, 41}};
    for (const auto compression : kCompressions) {
        part.compression = compression;
        write_exr(path, {part});
        expect_same_as_openexr(path, 0, {1U, 2U, 3U, 4U});
        const auto refused = make_block_source(ExrFile::open(path).value(), 0, {0U});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    }
}

TEST(BlockSource, DeepPartsAreRefused) {
    const TestFolder folder;
    const std::string path = folder.path("deep.exr");
    TestPart part{{{"T.500nm"}}};
    part.deep = true;
    part.compression = Imf::ZIPS_COMPRESSION;
    write_exr(path, {part});
    EXPECT_EQ(make_block_source(ExrFile::open(path).value(), 0, {0U}).error().code, ErrorCode::Unsupported);
}

TEST(BlockSource, ManyReadersShareOneFile) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    TestPart part{band_channels("T", 400, 10, 700, Imf::HALF)};
    part.data_window = {{0, 0}, {63, 399}};
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        part.compression = compression;
        write_exr(path, {part});
        const auto file = ExrFile::open(path).value();
        const auto source = make_block_source(file, 0, all_of(31)).value();
        const auto expected = test::read_with_openexr(path, 0, "T.400nm");
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t)
            threads.emplace_back([&] {
                const auto reader = source->start_reader().value();
                for (std::size_t block = 0; block < source->block_count(); ++block) {
                    const auto read = reader->read(block);
                    ASSERT_TRUE(read);
                    const std::size_t skip = static_cast<std::size_t>(read->first_row) * 64;
                    read->for_each_run([&](std::size_t first, std::size_t length, auto views) {
                        EXPECT_EQ(
                            std::memcmp(views[0].data, expected.data() + (skip + first) * 2, length * 2), 0);
                    });
                }
            });
    }
}

TEST_P(EveryCompression, EveryTruncationOfThePixelsIsAnError) {
    const TestFolder folder;
    const std::string path = folder.path("whole.exr"), cut = folder.path("cut.exr");
    TestPart part{band_channels("T", 400, 50, 700, Imf::HALF)};
    part.compression = GetParam();
    write_exr(path, {part});
    std::ifstream in(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t length = bytes.size() - 1; length > bytes.size() / 2; length -= 211) {
        std::ofstream(cut, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(length));
        const auto file = ExrFile::open(cut);
        if (!file)
            continue;
        const auto source = make_block_source(*file, 0, all_of(7)).value();
        const auto reader = source->start_reader();
        bool failed = !reader;
        for (std::size_t block = 0; !failed && block < source->block_count(); ++block)
            failed = !(*reader)->read(block);
        EXPECT_TRUE(failed) << "cut at " << length << " of " << bytes.size();
    }
}

}  // namespace
}  // namespace osio::exr
