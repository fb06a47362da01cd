// SPDX-License-Identifier: Apache-2.0
//
// Chunks that no writer makes. What writers make is compared with OpenEXR's own reading in
// block_source_test.
#include <formats/exr/chunk_codec.h>
#include <formats/exr/zip_bytes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace osio::exr {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The lines, or nothing where the chunk is refused; only Damaged refuses.
std::optional<Bytes> unpacked(ChunkCodec& codec, const Bytes& packed, ChunkShape shape,
                              std::size_t pixel_bytes) {
    Bytes lines(shape.width * shape.height * pixel_bytes);
    const auto result = codec.unpack(packed, shape, lines);
    if (result)
        return lines;
    EXPECT_EQ(result.error().code, ErrorCode::Damaged);
    return std::nullopt;
}

TEST(ChunkCodec, RunsFillTheLinesExactly) {
    const auto codec = make_rle_codec();
    const ChunkShape shape{4, 1};
    Bytes plain{1, 2, 3, 4, 5, 6, 7, 8}, zipped(8);
    zip_reference(plain, zipped.data());
    Bytes runs(9, static_cast<std::uint8_t>(-8));
    std::copy(zipped.begin(), zipped.end(), runs.begin() + 1);
    EXPECT_EQ(unpacked(*codec, runs, shape, 2), plain);
    // 8 times the same byte: two runs of 3 and 5.
    const Bytes same(8, 77);
    Bytes expected(8);
    UnzipCursor cursor = start_unzip_reference(same);
    unzip_reference(cursor, expected);
    EXPECT_EQ(unpacked(*codec, {2, 77, 4, 77}, shape, 2), expected);
    for (const Bytes& wrong :
         {Bytes{2, 77, 3, 77}, Bytes{2, 77, 5, 77}, Bytes{2, 77, 4, 77, 0}, Bytes{2, 77, 4},
          Bytes{static_cast<std::uint8_t>(-8), 1, 2, 3}, Bytes{0x80, 1, 2}, Bytes{}})
        EXPECT_FALSE(unpacked(*codec, wrong, shape, 2)) << wrong.size();
}

TEST(ChunkCodec, BlocksOfB44AreAsLongAsTheySay) {
    const auto codec = make_b44_codec({SampleType::Half, SampleType::Float});
    const ChunkShape shape{5, 3};  // two blocks, both partly outside, then 15 floats
    const std::uint8_t shift = 13 << 2;
    Bytes chunk{0x80, 0x01, shift, 0x80, 0x01, shift};
    for (std::uint8_t i = 0; i < 60; ++i)
        chunk.push_back(i);
    const auto lines = unpacked(*codec, chunk, shape, 6);
    ASSERT_TRUE(lines);
    for (std::size_t y = 0; y < 3; ++y)
        for (std::size_t x = 0; x < 5; ++x) {
            EXPECT_EQ((*lines)[y * 30 + 2 * x], 1);  // 0x8001 is the half with bits 0x0001
            EXPECT_EQ((*lines)[y * 30 + 2 * x + 1], 0);
            EXPECT_EQ((*lines)[y * 30 + 10 + 4 * x], (y * 5 + x) * 4);
        }
    for (std::size_t length = 0; length < chunk.size(); ++length)
        EXPECT_FALSE(
            unpacked(*codec, Bytes(chunk.begin(), chunk.begin() + static_cast<long>(length)), shape, 6))
            << length;
    chunk.push_back(0);
    EXPECT_FALSE(unpacked(*codec, chunk, shape, 6));
}

TEST(ChunkCodec, NoiseIsRefusedOrFillsTheLines) {
    const std::vector<SampleType> channels{SampleType::Half, SampleType::Uint, SampleType::Float};
    const ChunkShape shape{7, 5};
    std::mt19937 random(5);
    std::vector<std::unique_ptr<ChunkCodec>> codecs;
    codecs.push_back(make_zip_codec());
    codecs.push_back(make_rle_codec());
    codecs.push_back(make_pxr24_codec(channels));
    codecs.push_back(make_b44_codec(channels));
    codecs.push_back(make_stored_codec());
    for (const auto& codec : codecs)
        for (int round = 0; round < 2000; ++round) {
            Bytes packed(random() % (shape.width * shape.height * 10));
            for (std::uint8_t& byte : packed)
                byte = static_cast<std::uint8_t>(random() % (round % 2 == 0 ? 256 : 4));
            (void)unpacked(*codec, packed, shape, 10);
        }
}

}  // namespace
}  // namespace osio::exr
