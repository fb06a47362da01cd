// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/exr_writer.h>
#include <formats/files/replacement_file.h>
#include <formats/files/text_file.h>

#include <support/exr_files.h>

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
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
