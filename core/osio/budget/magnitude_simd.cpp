// SPDX-License-Identifier: Apache-2.0
//
// It is compiled once for each instruction set. Fused or not, a sum is within MagnitudeWeights::slack().
#include <osio/budget/magnitude.h>
#include <osio/collapse/kernel.h>

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "osio/budget/magnitude_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace osio {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Before AVX2 there is no exact conversion of halves in Highway (kernel_simd.cpp says more).
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_HAVE_SCALABLE || HWY_TARGET > HWY_AVX2

static std::size_t measure_groups(std::span<const BandView>, const MagnitudeWeights&, SampleMeasure,
                                  std::size_t, std::size_t, std::span<float* const>) {
    return 0;
}

#else

using Floats = hn::ScalableTag<float>;
using Halves = hn::Rebind<hwy::float16_t, Floats>;
using Sums = hn::Vec<Floats>;

/// Vectors of pixels at a time: three rows of sums and the samples fit into 16 registers.
constexpr std::size_t kVectors = 3;
constexpr std::size_t kMostRows = 3;

static HWY_INLINE Sums load(const BandView& band, std::size_t pixel) {
    if (band.type == SampleType::Half)
        return hn::PromoteTo(Floats(),
                             hn::LoadU(Halves(), reinterpret_cast<const hwy::float16_t*>(band.data) + pixel));
    return hn::LoadU(Floats(), reinterpret_cast<const float*>(band.data) + pixel);
}

template <std::size_t kRows>
static void measure_rows(std::span<const BandView> bands, const MagnitudeWeights& weights, std::uint32_t mask,
                         std::size_t first_row, std::size_t pixel_count, std::span<float* const> out) {
    const Floats d;
    constexpr std::size_t kLanes = hn::MaxLanes(Floats()), kStep = kVectors * kLanes;
    const auto bits = hn::BitCast(d, hn::Set(hn::RebindToUnsigned<Floats>(), mask));
    const auto slack = hn::Set(d, weights.slack());
    const auto least = hn::Set(d, kMagnitudeUnderflow);
    for (std::size_t next = 0; next < pixel_count; next += kStep) {
        const std::size_t pixel = std::min(next, pixel_count - kStep);
        Sums sums[kRows][kVectors];
#pragma GCC unroll 16
        for (std::size_t row = 0; row < kRows; ++row)
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                sums[row][v] = hn::Zero(d);
        for (std::size_t band = 0; band < bands.size(); ++band) {
            if (bands[band].data == nullptr)
                continue;
            Sums samples[kVectors];
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                samples[v] = hn::And(load(bands[band], pixel + v * kLanes), bits);
#pragma GCC unroll 16
            for (std::size_t row = 0; row < kRows; ++row) {
                const float weight = weights.at(first_row + row, band);
                if (weight == 0)
                    continue;
                const auto w = hn::Set(d, weight);
#pragma GCC unroll 16
                for (std::size_t v = 0; v < kVectors; ++v)
                    sums[row][v] = hn::MulAdd(w, samples[v], sums[row][v]);
            }
        }
#pragma GCC unroll 16
        for (std::size_t row = 0; row < kRows; ++row)
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                hn::StoreU(hn::MulAdd(sums[row][v], slack, least), d,
                           out[first_row + row] + pixel + v * kLanes);
    }
}

/// Some rows from `first_row` on; returns how many, 0 where the run is too short.
static std::size_t measure_groups(std::span<const BandView> bands, const MagnitudeWeights& weights,
                                  SampleMeasure measure, std::size_t first_row, std::size_t pixel_count,
                                  std::span<float* const> out) {
    if (pixel_count < kVectors * hn::MaxLanes(Floats()))
        return 0;
    // Without the sign; of a binade without the fraction too.
    const std::uint32_t mask = measure == SampleMeasure::Magnitude ? 0x7FFFFFFF : 0x7F800000;
    const std::size_t rows = std::min(weights.rows() - first_row, kMostRows);
    if (rows == 1)
        measure_rows<1>(bands, weights, mask, first_row, pixel_count, out);
    else if (rows == 2)
        measure_rows<2>(bands, weights, mask, first_row, pixel_count, out);
    else
        measure_rows<3>(bands, weights, mask, first_row, pixel_count, out);
    return rows;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace osio

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osio {

HWY_EXPORT(measure_groups);

void magnitude_run(std::span<const BandView> bands, const MagnitudeWeights& weights, SampleMeasure measure,
                   std::size_t pixel_count, std::span<float* const> out) {
    if (!std::all_of(bands.begin(), bands.end(), is_vectorisable))
        return magnitude_run_reference(bands, weights, measure, pixel_count, out);
    for (std::size_t row = 0; row < weights.rows();) {
        const std::size_t done =
            HWY_DYNAMIC_DISPATCH(measure_groups)(bands, weights, measure, row, pixel_count, out);
        if (done == 0)
            return magnitude_run_reference(bands, weights, measure, pixel_count, out);
        row += done;
    }
}

}  // namespace osio
#endif
