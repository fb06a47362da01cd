// SPDX-License-Identifier: Apache-2.0
//
// Compiled once for each instruction set; the reference does the rest of each run.
#include <formats/exr/zip_bytes.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "formats/exr/zip_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace osio::exr {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

static std::size_t unzip_blocks(UnzipCursor&, std::span<std::uint8_t>) {
    return 0;
}

static std::size_t sum_blocks(std::span<const std::uint8_t>, std::uint8_t&) {
    return 0;
}

static std::size_t zip_blocks(std::span<const std::uint8_t>, std::uint8_t*) {
    return 1;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

/// A running sum needs its neighbours: blocks of 16 bytes, whatever the instruction set has beyond.
using Block = hn::FixedTag<std::uint8_t, 16>;
using Bytes = hn::Vec<Block>;

/// v[0], v[0] + v[1], ..., v[0] + .. + v[15].
static HWY_INLINE Bytes running_sum(Bytes v) {
    const Block d;
    v = hn::Add(v, hn::ShiftLeftBytes<1>(d, v));
    v = hn::Add(v, hn::ShiftLeftBytes<2>(d, v));
    v = hn::Add(v, hn::ShiftLeftBytes<4>(d, v));
    return hn::Add(v, hn::ShiftLeftBytes<8>(d, v));
}

/// Blocks of 16 pairs; returns how many bytes of `out` were made.
static std::size_t unzip_blocks(UnzipCursor& cursor, std::span<std::uint8_t> out) {
    const Block d;
    const auto bias = hn::Set(d, 128);  // to add and to subtract 128 are one modulo 256
    const auto last = hn::Set(d, 15);
    auto even_before = hn::Set(d, cursor.even_before);
    auto odd_before = hn::Set(d, cursor.odd_before);
    std::size_t done = 0;
    for (; done + 32 <= out.size(); done += 32) {
        const auto even_sums = running_sum(hn::Xor(hn::LoadU(d, cursor.even + done / 2), bias));
        const auto odd_sums = running_sum(hn::Xor(hn::LoadU(d, cursor.odd + done / 2), bias));
        const auto even = hn::Add(even_sums, even_before);
        const auto odd = hn::Add(odd_sums, odd_before);
        // The chain from block to block: one shuffle, off it, and one sum.
        even_before = hn::Add(even_before, hn::TableLookupBytes(even_sums, last));
        odd_before = hn::Add(odd_before, hn::TableLookupBytes(odd_sums, last));
        hn::StoreU(hn::InterleaveLower(d, even, odd), d, out.data() + done);
        hn::StoreU(hn::InterleaveUpper(d, even, odd), d, out.data() + done + 16);
    }
    cursor.even += done / 2;
    cursor.odd += done / 2;
    cursor.even_before = hn::GetLane(even_before);
    cursor.odd_before = hn::GetLane(odd_before);
    return done;
}

/// Adds bytes to `sum`, modulo 256; returns how many.
static std::size_t sum_blocks(std::span<const std::uint8_t> bytes, std::uint8_t& sum) {
    const hn::ScalableTag<std::uint8_t> d;
    const hn::ScalableTag<std::uint64_t> d64;
    const std::size_t step = hn::Lanes(d);
    auto sums = hn::Zero(d64);
    std::size_t done = 0;
    for (; done + step <= bytes.size(); done += step)
        sums = hn::Add(sums, hn::SumsOf8(hn::LoadU(d, bytes.data() + done)));
    sum = static_cast<std::uint8_t>(sum + hn::GetLane(hn::SumOfLanes(d64, sums)));
    return done;
}

/// Pairs from the second on; returns the pair that comes next.
static std::size_t zip_blocks(std::span<const std::uint8_t> bytes, std::uint8_t* out) {
    const hn::ScalableTag<std::uint8_t> d;
    const std::size_t step = hn::Lanes(d), half = bytes.size() / 2;
    const auto bias = hn::Set(d, 128);
    std::size_t pair = 1;
    for (; pair + step <= half; pair += step) {
        hn::Vec<decltype(d)> even, odd, even_before, odd_before;
        hn::LoadInterleaved2(d, bytes.data() + 2 * pair, even, odd);
        hn::LoadInterleaved2(d, bytes.data() + 2 * pair - 2, even_before, odd_before);
        hn::StoreU(hn::Xor(hn::Sub(even, even_before), bias), d, out + pair);
        hn::StoreU(hn::Xor(hn::Sub(odd, odd_before), bias), d, out + half + pair);
    }
    return pair;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace osio::exr

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osio::exr {

HWY_EXPORT(unzip_blocks);
HWY_EXPORT(sum_blocks);
HWY_EXPORT(zip_blocks);

UnzipCursor start_unzip(std::span<const std::uint8_t> zipped) {
    const std::span<const std::uint8_t> even = zipped.first(zipped.size() / 2);
    UnzipCursor cursor{even.data(), even.data() + even.size(), 128, 128};
    std::size_t at = HWY_DYNAMIC_DISPATCH(sum_blocks)(even, cursor.odd_before);
    for (; at < even.size(); ++at)
        cursor.odd_before = static_cast<std::uint8_t>(cursor.odd_before + even[at]);
    // -128 for each byte: nothing where they are even in number.
    cursor.odd_before = static_cast<std::uint8_t>(cursor.odd_before + 128 * (even.size() % 2));
    return cursor;
}

void unzip(UnzipCursor& cursor, std::span<std::uint8_t> out) {
    unzip_reference(cursor, out.subspan(HWY_DYNAMIC_DISPATCH(unzip_blocks)(cursor, out)));
}

void zip(std::span<const std::uint8_t> bytes, std::uint8_t* out) {
    const std::size_t half = bytes.size() / 2;
    if (half == 0)
        return;
    out[0] = bytes[0];
    out[half] = static_cast<std::uint8_t>(bytes[1] - bytes[bytes.size() - 2] + 128);
    for (std::size_t pair = HWY_DYNAMIC_DISPATCH(zip_blocks)(bytes, out); pair < half; ++pair) {
        out[pair] = static_cast<std::uint8_t>(bytes[2 * pair] - bytes[2 * pair - 2] + 128);
        out[half + pair] = static_cast<std::uint8_t>(bytes[2 * pair + 1] - bytes[2 * pair - 1] + 128);
    }
}

}  // namespace osio::exr
#endif
