// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/convert.h>
#include <formats/image/open_image.h>

#include <support/exr_files.h>

#include <gtest/gtest.h>

namespace osio::convert {
namespace {

/// One worker, here and now.
class OneWorker final : public Runner {
  public:
    [[nodiscard]] unsigned worker_count() const override { return 1; }

    void run(const std::function<void(unsigned)>& body) override { body(0); }
};

TEST(ConvertParts, DeepAndSubsampledPartsAreNamedAsLostAndTheOthersGoOver) {
    const test::TestFolder folder;
    test::TestPart bands({{"T.400nm"}, {"T.500nm"}}), deep({{"Z"}}),
        subsampled({{"Y"}, {"RY", Imf::FLOAT, 2}});
    bands.name = "bands";
    deep.name = "deep";
    deep.deep = true;
    deep.compression = Imf::ZIPS_COMPRESSION;
    subsampled.name = "chroma";
    subsampled.data_window = {{0, 0}, {35, 51}};
    subsampled.display_window = bands.data_window;
    test::write_exr(folder.path("in.exr"), {deep, bands, subsampled});
    Request request;
    request.input = folder.path("in.exr");
    request.output = folder.path("out.exr");
    OneWorker runner;
    const auto outcome = convert(request, runner, {});
    ASSERT_TRUE(outcome) << outcome.error().text();
    EXPECT_EQ(outcome->lost,
              (std::vector<std::string>{"part 0, which is deep", "part 2, which is sub-sampled"}));
    EXPECT_EQ(outcome->bands, 2U);
    const auto file = image::open_image(request.output);
    ASSERT_TRUE(file);
    ASSERT_EQ((*file)->parts().size(), 1U);
    EXPECT_EQ((*file)->parts()[0].name, "bands");
}

}  // namespace
}  // namespace osio::convert
