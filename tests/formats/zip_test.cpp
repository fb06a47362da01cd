// SPDX-License-Identifier: Apache-2.0
//
// The ZIP stages against their obvious twins, over sizes, alignments, cuts and instruction sets; and
// the refusals of the decoder.
#include <formats/exr/zip_bytes.h>
#include <formats/exr/zip_codec.h>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <random>
#include <vector>

namespace osio::exr {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes noise(std::size_t count, unsigned seed, unsigned values = 256) {
    std::mt19937 random(seed);
    Bytes out(count);
    for (std::uint8_t& byte : out)
        byte = static_cast<std::uint8_t>(random() % values);
    return out;
}

constexpr std::uint8_t kMark = 0xA5;

const std::vector<std::size_t> kSizes{0,  2,  4,  14,  16,  30,   32,   34,   62,   64,
                                      66, 94, 96, 126, 128, 1000, 1022, 4096, 4098, 61440};

class ZipOn : public testing::TestWithParam<std::int64_t> {
  protected:
    void SetUp() override {
        hwy::SetSupportedTargetsForTest(GetParam());
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }

    void TearDown() override {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

TEST_P(ZipOn, FastAndReferenceMakeTheSameBytes) {
    for (const std::size_t size : kSizes)
        for (const std::size_t offset : {0U, 1U, 7U, 31U}) {
            SCOPED_TRACE(testing::Message() << size << " bytes, offset " << offset);
            const Bytes memory = noise(size + offset, static_cast<unsigned>(size));
            const std::span<const std::uint8_t> bytes = std::span(memory).subspan(offset);
            Bytes fast(offset + size + 1, kMark), slow(offset + size + 1, kMark);
            zip(bytes, fast.data() + offset);
            zip_reference(bytes, slow.data() + offset);
            EXPECT_EQ(fast, slow);
            EXPECT_EQ(fast.back(), kMark);
        }
}

TEST_P(ZipOn, UnzipIsTheReferenceWhereverTheLinesEnd) {
    for (const std::size_t size : kSizes)
        for (const std::size_t offset : {0U, 1U, 7U, 31U})
            for (const std::size_t line : {std::size_t{2}, std::size_t{30}, std::size_t{66}, size}) {
                SCOPED_TRACE(testing::Message()
                             << size << " bytes, offset " << offset << ", lines of " << line);
                const Bytes memory = noise(size + offset, static_cast<unsigned>(size) + 1);
                const std::span<const std::uint8_t> zipped = std::span(memory).subspan(offset);
                UnzipCursor fast_cursor = start_unzip(zipped);
                UnzipCursor slow_cursor = start_unzip_reference(zipped);
                EXPECT_EQ(fast_cursor.odd_before, slow_cursor.odd_before);
                Bytes fast(offset + size + 1, kMark), slow(size);
                for (std::size_t at = 0; at < size; at += line) {
                    const std::size_t count = std::min(line, size - at);
                    unzip(fast_cursor, std::span(fast).subspan(offset + at, count));
                }
                unzip_reference(slow_cursor, slow);
                EXPECT_TRUE(std::equal(slow.begin(), slow.end(), fast.begin() + static_cast<long>(offset)));
                EXPECT_EQ(fast.back(), kMark);
            }
}

TEST_P(ZipOn, UnzipUndoesZip) {
    for (const std::size_t size : kSizes) {
        const Bytes bytes = noise(size, 3);
        Bytes zipped(size), back(size);
        zip(bytes, zipped.data());
        UnzipCursor cursor = start_unzip(zipped);
        unzip(cursor, back);
        EXPECT_EQ(back, bytes) << size;
    }
}

std::vector<std::int64_t> targets_of_this_machine() {
    std::vector<std::int64_t> out;
    for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
        const std::int64_t target = targets & -targets;
        if (hwy::TargetName(target) != std::string("Unknown"))  // bits that are reserved
            out.push_back(target);
    }
    return out;
}

INSTANTIATE_TEST_SUITE_P(Targets, ZipOn, testing::ValuesIn(targets_of_this_machine()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

TEST(Zip, TheOrderIsTheOneThatOpenExrWrites) {
    // Written out by hand: even bytes 10 30 50, odd bytes 20 40 60, then differences plus 128.
    const Bytes bytes{10, 20, 30, 40, 50, 60};
    Bytes zipped(6);
    zip_reference(bytes, zipped.data());
    EXPECT_EQ(zipped, (Bytes{10, 148, 148, 98, 148, 148}));
}

Bytes packed(const Bytes& bytes, int level = 4) {
    ZipEncoder encoder(level);
    Bytes out;
    encoder.encode(bytes, out);
    return out;
}

TEST(ZipCodec, EveryLevelComesBackWholeAndInLines) {
    const Bytes bytes = noise(30000, 4, 20);
    for (int level = 1; level <= 12; ++level) {
        const Bytes chunk = packed(bytes, level);
        EXPECT_LT(chunk.size(), bytes.size());
        Inflater inflater;
        const auto zipped = inflater.inflate(chunk, bytes.size());
        ASSERT_TRUE(zipped);
        UnzipCursor cursor = start_unzip(*zipped);
        Bytes back(bytes.size());
        for (std::size_t line = 0; line < 30; ++line)
            unzip(cursor, std::span(back).subspan(line * 1000, 1000));
        EXPECT_EQ(back, bytes);
    }
}

TEST(ZipCodec, WhatDoesNotShrinkIsStoredAsItIs) {
    for (const std::size_t size : {2U, 8U, 5000U}) {
        const Bytes bytes = noise(size, 5);
        EXPECT_EQ(packed(bytes), bytes);
    }
}

TEST(ZipCodec, EncoderAppends) {
    ZipEncoder encoder(4);
    Bytes out{1, 2, 3};
    const Bytes bytes = noise(1000, 6, 4);
    encoder.encode(bytes, out);
    const Bytes alone = packed(bytes);
    ASSERT_EQ(out.size(), alone.size() + 3);
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), out.begin() + 3));
}

/// A stream is refused at each cut, at each flipped bit, for each wrong size, and with bytes behind it.
TEST(ZipCodec, NoDamageOfAChunkIsSilent) {
    const Bytes bytes = noise(600, 7, 9);
    const Bytes whole = packed(bytes);
    Inflater inflater;
    const auto refused = [&](const Bytes& chunk, std::size_t size) {
        const auto result = inflater.inflate(chunk, size);
        return !result && result.error().code == ErrorCode::Damaged;
    };
    ASSERT_FALSE(refused(whole, bytes.size()));
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_TRUE(refused(Bytes(whole.begin(), whole.begin() + static_cast<long>(length)), bytes.size()))
            << length;
    for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
        Bytes flipped = whole;
        flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << (bit % 8)));
        if (const auto zipped = inflater.inflate(flipped, bytes.size())) {
            UnzipCursor cursor = start_unzip(*zipped);
            Bytes back(bytes.size());
            unzip(cursor, back);
            EXPECT_EQ(back, bytes) << bit;
        }
    }
    for (const std::size_t size : {bytes.size() - 2, bytes.size() + 2, std::size_t{60000}})
        EXPECT_TRUE(refused(whole, size)) << size;
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_TRUE(refused(longer, bytes.size()));
    EXPECT_TRUE(refused({}, bytes.size()));
}

}  // namespace
}  // namespace osio::exr
