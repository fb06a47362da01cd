// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/checksum.h>
#include <formats/exr/chunk_map.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/files/replacement_file.h>
#include <formats/files/text_file.h>

#include <support/exr_files.h>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace osio::exr {
namespace {

using test::TestFolder;

std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::unique_ptr<ExrSink> sink_for(const std::string& path, SampleType type, int width, int height) {
    const std::vector<OutputChannel> channels{{"R", type}, {"G", type}, {"B", type}};
    return std::make_unique<ExrSink>(ExrWriter::create(path, Imf::Header(width, height), channels).value(),
                                     type, width);
}

TEST(ExrSink, FloatsAreStoredAsTheyAre) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    const std::vector<float> r{1.5F, -2, 1e38F, 1e-45F}, g(4, 0.1F), b(4, -0.0F);
    auto sink = sink_for(path, SampleType::Float, 2, 2);
    for (int row = 0; row < 2; ++row) {
        const std::vector<const float*> planes{&r[static_cast<std::size_t>(2 * row)], &g[0], &b[0]};
        ASSERT_TRUE(sink->write_rows(row, 1, planes));
    }
    ASSERT_TRUE(sink->finish());
    const auto stored = test::read_with_openexr(path, 0, "R");
    EXPECT_EQ(std::memcmp(stored.data(), r.data(), stored.size()), 0);
    EXPECT_EQ(folder.files(), std::vector<std::string>{"a.exr"});
}

TEST(ExrSink, HalvesAreClampedToTheirLargestAndCounted) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> r{65504, 65505,   -7e4F, inf, -inf, std::numeric_limits<float>::quiet_NaN(),
                               0.1F,  65503.9F};
    auto sink = sink_for(path, SampleType::Half, 8, 1);
    const std::vector<const float*> planes{r.data(), r.data(), r.data()};
    ASSERT_TRUE(sink->write_rows(0, 1, planes));
    EXPECT_EQ(sink->clamped_count(), 3U * 4U);
    ASSERT_TRUE(sink->finish());
    const auto stored = test::read_with_openexr(path, 0, "G");
    std::vector<Imath::half> halves(8);
    std::memcpy(static_cast<void*>(halves.data()), stored.data(), stored.size());
    for (const std::size_t i : {0U, 1U, 3U, 7U})
        EXPECT_EQ(static_cast<float>(halves[i]), 65504.0F) << i;
    for (const std::size_t i : {2U, 4U})
        EXPECT_EQ(static_cast<float>(halves[i]), -65504.0F) << i;
    EXPECT_TRUE(halves[5].isNan());
    EXPECT_EQ(halves[6].bits(), Imath::half(0.1F).bits());
}

TEST(ExrWriter, AnUnfinishedFileLeavesTheOldOneAndNoLitter) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    std::ofstream(path) << "the old file";
    const std::vector<float> row(4, 1.0F);
    const std::vector<const float*> planes{row.data(), row.data(), row.data()};
    {
        auto sink = sink_for(path, SampleType::Float, 4, 4);
        ASSERT_TRUE(sink->write_rows(0, 1, planes));
        EXPECT_EQ(folder.files().size(), 2U);
    }
    EXPECT_EQ(content(path), "the old file");
    EXPECT_EQ(folder.files(), std::vector<std::string>{"a.exr"});
    {
        auto sink = sink_for(path, SampleType::Float, 4, 4);
        ASSERT_TRUE(sink->write_rows(0, 1, planes));
        const auto early = sink->finish();
        ASSERT_FALSE(early);
        EXPECT_EQ(early.error().what, "3 rows were never written");
    }
    EXPECT_EQ(content(path), "the old file");
}

/// Channels of every type, with one name too long for a plain header, over a window that starts
/// anywhere; `noise` does not compress.
struct Picture {
    Imf::Header header{Imath::Box2i({-3, 2}, {100, 90}), Imath::Box2i({-5, -9}, {31, 60})};
    std::vector<OutputChannel> channels{{"T.500,0nm", SampleType::Half},
                                        {"A", SampleType::Float},
                                        {"id", SampleType::Uint},
                                        {"a_long_name_of_more_than_31_letters.T.400,0nm", SampleType::Float}};
    std::size_t width = 37, height = 70, pixel_bytes = 14;
    std::vector<std::byte> pixels;  ///< interleaved

    explicit Picture(Imf::Compression compression, bool noise) {
        header.compression() = compression;
        header.insert("owner", Imf::StringAttribute("somebody"));
        std::mt19937 random(3);
        pixels.resize(width * height * pixel_bytes);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = static_cast<std::byte>(noise ? random() : i / 40 % 7);
    }

    [[nodiscard]] std::vector<ChannelRows> rows(std::size_t first) const {
        std::vector<ChannelRows> out;
        std::size_t offset = first * width * pixel_bytes;
        for (const OutputChannel& channel : channels) {
            out.push_back({pixels.data() + offset, static_cast<std::ptrdiff_t>(pixel_bytes),
                           static_cast<std::ptrdiff_t>(width * pixel_bytes)});
            offset += sample_bytes(channel.type);
        }
        return out;
    }

    /// A channel's samples, row after row.
    [[nodiscard]] std::string plane(std::size_t channel) const {
        const auto from = rows(0)[channel];
        std::string out;
        for (std::size_t i = 0; i < width * height; ++i)
            out.append(reinterpret_cast<const char*>(from.data + i * pixel_bytes),
                       sample_bytes(channels[channel].type));
        return out;
    }

    /// The file that OpenEXR's own writer makes.
    void write_by_openexr(const std::string& path) {
        Imf::Header own = header;
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const Imf::PixelType type = pixel_type(channels[c].type);
            own.channels().insert(channels[c].name, Imf::Channel(type));
            buffer.insert(channels[c].name, Imf::Slice::Make(type, rows(0)[c].data, own.dataWindow(),
                                                             pixel_bytes, width * pixel_bytes));
        }
        Imf::OutputFile file(path.c_str(), own);
        file.setFrameBuffer(buffer);
        file.writePixels(static_cast<int>(height));
    }
};

/// All rows, so many at a time.
void write_in_steps(ExrWriter& writer, const Picture& picture, std::size_t step, Runner* runner) {
    for (std::size_t row = 0; row < picture.height; row += step) {
        const std::size_t count = std::min(step, picture.height - row);
        ASSERT_TRUE(writer.write_rows(static_cast<int>(count), picture.rows(row), runner));
    }
}

/// A file of ours without its checksum, which is all that its header has beyond OpenEXR's.
std::string without_checksum(std::string bytes) {
    const std::string name =
        std::string(exr::attribute::kChecksum) + '\0' + std::string(exr::attribute::kChecksumType) + '\0';
    const std::size_t at = bytes.find(name);
    if (at == std::string::npos)
        return "no checksum";
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at + name.size(), sizeof size);
    return bytes.erase(at, name.size() + sizeof size + size);
}

/// Whatever rows come at a time, by whatever threads: OpenEXR reads the samples that were given, the
/// file's bytes do not depend on the way, and but for the checksum the header is the one that OpenEXR
/// writes.
TEST(ExrWriter, ZipFilesAreThoseOfOpenExr) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr"), other = folder.path("b.exr");
    tool::ThreadRunner threads(3);
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::ZIPS_COMPRESSION})
        for (const bool noise : {false, true}) {
            Picture picture(compression, noise);
            picture.write_by_openexr(other);
            const std::string expected = content(other);
            std::string first_way;
            for (const std::size_t step : {1U, 5U, 16U, 23U, 70U})
                for (Runner* runner : {static_cast<Runner*>(nullptr), static_cast<Runner*>(&threads)}) {
                    auto writer = ExrWriter::create(path, picture.header, picture.channels).value();
                    write_in_steps(*writer, picture, step, runner);
                    ASSERT_TRUE(writer->finish());
                    const std::string bytes = content(path);
                    if (first_way.empty())
                        first_way = bytes;
                    EXPECT_EQ(bytes, first_way) << step << " rows at a time";
                }
            for (std::size_t c = 0; c < picture.channels.size(); ++c) {
                const auto stored = test::read_with_openexr(path, 0, picture.channels[c].name);
                EXPECT_EQ(std::string(stored.begin(), stored.end()), picture.plane(c));
            }
            const std::string bare = without_checksum(first_way);
            const std::size_t table = expected.find("screenWindowWidth") + sizeof("screenWindowWidth") +
                                      sizeof("float") + 2 * sizeof(float) + 1;
            EXPECT_EQ(bare.substr(0, table), expected.substr(0, table));
            // Noise is stored as it is, which leaves nothing to differ.
            const std::size_t chunks =
                compression == Imf::ZIP_COMPRESSION ? (picture.height + 15) / 16 : picture.height;
            if (noise) {
                EXPECT_EQ(bare.substr(table + 8 * chunks), expected.substr(table + 8 * chunks));
            }
        }
}

/// Tiles of any size, whatever rows come at a time, packed by ourselves or by OpenEXR: OpenEXR reads the samples that
/// were given, our reader does too, and every chunk has its checksum.
TEST(ExrWriter, TilesAreReadByOpenExr) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    tool::ThreadRunner threads(3);
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::NO_COMPRESSION,
                                   Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION})
        for (const auto& [tile_width, tile_height] :
             {std::pair{16U, 8U}, {7U, 70U}, {64U, 64U}, {37U, 1U}, {200U, 300U}}) {
            Picture picture(compression, tile_width == 16);
            picture.header.setTileDescription(Imf::TileDescription(tile_width, tile_height));
            std::string first_way;
            for (const std::size_t step : {1U, 9U, 16U, 70U})
                for (Runner* runner : {static_cast<Runner*>(nullptr), static_cast<Runner*>(&threads)}) {
                    auto writer = ExrWriter::create(path, picture.header, picture.channels).value();
                    write_in_steps(*writer, picture, step, runner);
                    ASSERT_TRUE(writer->finish());
                    if (first_way.empty())
                        first_way = content(path);
                    EXPECT_EQ(content(path), first_way) << step << " rows at a time";
                }
            for (std::size_t c = 0; c < picture.channels.size(); ++c) {
                const auto stored = test::read_with_openexr(path, 0, picture.channels[c].name);
                EXPECT_EQ(std::string(stored.begin(), stored.end()), picture.plane(c));
            }
            const auto file = ExrFile::open(path).value();
            EXPECT_TRUE(file->parts()[0].tiled);
            EXPECT_EQ(file->chunks().checksum(), ChunkMap::Sum::Own);
            std::string scratch;
            for (std::uint64_t chunk = 0; chunk < file->chunks().chunk_count(0); ++chunk)
                EXPECT_TRUE(file->chunks().check(0, chunk, scratch));
        }
}

/// Scanlines and tiles beside each other, rows of the parts in turn.
TEST(ExrWriter, PartsOfTilesAndOfScanlines) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        Picture lines(compression, false), tiles(compression, true);
        lines.header.setName("lines");
        tiles.header.setName("tiles");
        tiles.header.setTileDescription(Imf::TileDescription(16, 24));
        auto writer =
            ExrWriter::create(path, {{lines.header, lines.channels}, {tiles.header, tiles.channels}}).value();
        for (std::size_t row = 0; row < lines.height; row += 10) {
            ASSERT_TRUE(writer->write_rows(10, lines.rows(row), nullptr, 0));
            ASSERT_TRUE(writer->write_rows(10, tiles.rows(row), nullptr, 1));
        }
        ASSERT_TRUE(writer->finish());
        for (std::size_t c = 0; c < lines.channels.size(); ++c) {
            const auto first = test::read_with_openexr(path, 0, lines.channels[c].name);
            const auto second = test::read_with_openexr(path, 1, lines.channels[c].name);
            EXPECT_EQ(std::string(first.begin(), first.end()), lines.plane(c));
            EXPECT_EQ(std::string(second.begin(), second.end()), tiles.plane(c));
        }
        const auto file = ExrFile::open(path).value();
        EXPECT_EQ(file->chunks().checksum(), ChunkMap::Sum::Own);
        EXPECT_FALSE(file->parts()[0].tiled);
        EXPECT_TRUE(file->parts()[1].tiled);
    }
}

/// Limits how large files of this process may become, and makes the excess an error instead of a
/// signal: what a full disk looks like.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &m_old);

        const struct rlimit limit { bytes, m_old.rlim_max };

        ::setrlimit(RLIMIT_FSIZE, &limit);
    }

    ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &m_old); }

    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    struct rlimit m_old {};
};

TEST(ExrWriter, AFullDiskIsAnErrorWhereverItHappens) {
    const TestFolder folder;
    const std::string path = folder.path("a.exr");
    const std::vector<float> row(64, 1.0F);
    const std::vector<const float*> planes{row.data(), row.data(), row.data()};
    const auto write = [&] {
        auto sink = sink_for(path, SampleType::Float, 64, 100);
        for (int y = 0; y < 100; ++y)
            if (auto result = sink->write_rows(y, 1, planes); !result)
                return result;
        return sink->finish();
    };
    ASSERT_TRUE(write());
    const std::string whole = content(path);
    for (rlim_t room = 0; room < whole.size(); room += whole.size() / 23 + 1) {
        const FileSizeLimit limit(room);
        const auto result = write();
        ASSERT_FALSE(result) << room << " of " << whole.size() << " bytes";
        EXPECT_EQ(result.error().code, ErrorCode::Io);
        EXPECT_EQ(content(path), whole);
        EXPECT_EQ(folder.files().size(), 1U);
    }
}

TEST(ReplacementFile, PermissionsOfTheTargetStay) {
    const TestFolder folder;
    const std::string path = folder.path("a.txt");
    std::ofstream(path) << "old";
    ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
    auto file = files::ReplacementFile::create(path).value();
    std::ofstream(file.path()) << "new";
    ASSERT_TRUE(file.commit());

    struct stat status {};

    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777U, 0640U);
    EXPECT_EQ(content(path), "new");
}

TEST(ReplacementFile, OnlyOrdinaryFilesAreReplaced) {
    const TestFolder folder;
    EXPECT_EQ(files::ReplacementFile::create(folder.path("")).error().code, ErrorCode::Io);
    EXPECT_EQ(files::ReplacementFile::create("/dev/null").error().text(),
              "/dev/null: is not an ordinary file and is left alone");
    EXPECT_EQ(files::ReplacementFile::create(folder.path("no/such/folder.exr")).error().code, ErrorCode::Io);
}

TEST(ReplacementFile, LongNamesStillHaveATemporary) {
    const TestFolder folder;
    const std::string path = folder.path(std::string(250, 'x'));
    auto file = files::ReplacementFile::create(path);
    ASSERT_TRUE(file) << file.error().text();
    EXPECT_TRUE(file->commit());
    EXPECT_EQ(folder.files().size(), 1U);
}

TEST(TextFile, FoldersAndMissingFilesAreErrors) {
    const TestFolder folder;
    EXPECT_EQ(files::read_text(folder.path("none.csv")).error().code, ErrorCode::Io);
    EXPECT_EQ(files::read_text(folder.path("")).error().code, ErrorCode::Io);
    std::ofstream(folder.path("a.csv")) << "400,1\n";
    EXPECT_EQ(files::read_text(folder.path("a.csv")).value(), "400,1\n");
    EXPECT_EQ(files::text_loader(files::folder_of(folder.path("x")))("a.csv").value(), "400,1\n");
    EXPECT_EQ(files::folder_of("/x"), "/");
    EXPECT_EQ(files::folder_of("x"), "");
}

}  // namespace
}  // namespace osio::exr
