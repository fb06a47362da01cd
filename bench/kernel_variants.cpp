// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bench/kernel_variants.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/kernel_variants.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace osio::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Tag>
static HWY_INLINE hn::Vec<hn::Rebind<float, Tag>> load_floats(Tag, const BandView& band, std::size_t pixel) {
    const hn::Rebind<float, Tag> floats;
    if (band.type == SampleType::Float)
        return hn::LoadU(floats, reinterpret_cast<const float*>(band.data) + pixel);
    const hn::Rebind<hwy::float16_t, Tag> halves;
    const auto raw = hn::LoadU(halves, reinterpret_cast<const hwy::float16_t*>(band.data) + pixel);
    return hn::PromoteTo(floats, raw);
}

static void fused(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                  std::span<float* const> out) {
    const hn::ScalableTag<double> d;
    const hn::Rebind<float, decltype(d)> floats;
    constexpr std::size_t kVectors = 4, kLanes = hn::MaxLanes(d), kStep = kVectors * kLanes;
    for (std::size_t next = 0; next < pixel_count; next += kStep) {
        const std::size_t pixel = std::min(next, pixel_count - kStep);
        hn::Vec<decltype(d)> sums[3][kVectors];
#pragma GCC unroll 16
        for (auto& row : sums)
#pragma GCC unroll 16
            for (auto& sum : row)
                sum = hn::Zero(d);
        for (std::size_t band = 0; band < bands.size(); ++band) {
            hn::Vec<decltype(d)> samples[kVectors];
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                samples[v] = hn::PromoteTo(d, load_floats(d, bands[band], pixel + v * kLanes));
#pragma GCC unroll 16
            for (std::size_t row = 0; row < 3; ++row) {
                const auto w = hn::Set(d, weights.at(row, band));
#pragma GCC unroll 16
                for (std::size_t v = 0; v < kVectors; ++v)
                    sums[row][v] = hn::MulAdd(w, samples[v], sums[row][v]);
            }
        }
#pragma GCC unroll 16
        for (std::size_t row = 0; row < 3; ++row)
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                hn::StoreU(hn::DemoteTo(floats, sums[row][v]), floats, out[row] + pixel + v * kLanes);
    }
}

static void in_float(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                     std::span<float* const> out) {
    const hn::ScalableTag<float> d;
    const std::size_t lanes = hn::Lanes(d);
    for (float* const row : out.first(3))
        std::fill_n(row, pixel_count, 0.0F);
    for (std::size_t band = 0; band < bands.size(); ++band) {
        const auto x = hn::Set(d, static_cast<float>(weights.at(0, band)));
        const auto y = hn::Set(d, static_cast<float>(weights.at(1, band)));
        const auto z = hn::Set(d, static_cast<float>(weights.at(2, band)));
        for (std::size_t pixel = 0; pixel + lanes <= pixel_count; pixel += lanes) {
            const auto samples = load_floats(d, bands[band], pixel);
            hn::StoreU(hn::MulAdd(x, samples, hn::LoadU(d, out[0] + pixel)), d, out[0] + pixel);
            hn::StoreU(hn::MulAdd(y, samples, hn::LoadU(d, out[1] + pixel)), d, out[1] + pixel);
            hn::StoreU(hn::MulAdd(z, samples, hn::LoadU(d, out[2] + pixel)), d, out[2] + pixel);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace osio::bench

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osio::bench {

HWY_EXPORT(fused);
HWY_EXPORT(in_float);

void collapse_fused(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                    std::span<float* const> out) {
    HWY_DYNAMIC_DISPATCH(fused)(bands, weights, pixel_count, out);
}

void collapse_float(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                    std::span<float* const> out) {
    HWY_DYNAMIC_DISPATCH(in_float)(bands, weights, pixel_count, out);
}

}  // namespace osio::bench
#endif
