// SPDX-License-Identifier: Apache-2.0
//
// It is compiled once for each instruction set, with
// -ffp-contract=off: a compiler that fused Add(Mul(...)) would change the last bit.
#include <osio/base/half.h>
#include <osio/collapse/kernel.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "osio/collapse/kernel_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace osio {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_HAVE_SCALABLE

// Highway's emulation turns infinities into the largest float, and vectors whose width only the machine
// knows make no arrays. Leave all to the reference.
static std::size_t collapse_groups(std::span<const BandView>, const WeightMatrix&, std::size_t, std::size_t,
                                   std::span<float* const>) {
    return 0;
}

#else

using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Halves = hn::Rebind<hwy::float16_t, Doubles>;
using Sums = hn::Vec<Doubles>;

/// The next samples as doubles; samples need no alignment.
template <bool kHalf>
static HWY_INLINE Sums load_samples(const std::byte* from) {
    const Floats floats;
    if constexpr (!kHalf) {
        return hn::PromoteTo(Doubles(), hn::LoadU(floats, reinterpret_cast<const float*>(from)));
    } else {
#if HWY_TARGET <= HWY_AVX2
        // F16C converts every pattern exactly.
        const auto raw = hn::LoadU(Halves(), reinterpret_cast<const hwy::float16_t*>(from));
        return hn::PromoteTo(Doubles(), hn::PromoteTo(floats, raw));
#else
        // Without F16C Highway's own conversion does not keep infinities and NaN.
        HWY_ALIGN std::array<float, hn::MaxLanes(Floats())> lanes;
        for (std::size_t i = 0; i < hn::MaxLanes(floats); ++i) {
            std::uint16_t bits = 0;
            std::memcpy(&bits, from + i * sizeof bits, sizeof bits);
            lanes[i] = float_from_half(bits);
        }
        return hn::PromoteTo(Doubles(), hn::Load(floats, lanes.data()));
#endif
    }
}

/// Adds one band to the sums of kRows outputs, kVectors vectors of pixels each. `from` is the band's
/// first sample of the group, `weights` its weight for each output.
template <std::size_t kRows, std::size_t kVectors, bool kHalf>
static HWY_INLINE void add_band(const std::byte* from, const double* const* weights, std::size_t band,
                                Sums (&sums)[kRows][kVectors]) {
    const Doubles d;
    constexpr std::size_t kVectorBytes = hn::MaxLanes(Doubles()) * (kHalf ? 2 : 4);
    Sums samples[kVectors];
#pragma GCC unroll 16
    for (std::size_t v = 0; v < kVectors; ++v)
        samples[v] = load_samples<kHalf>(from + v * kVectorBytes);
#pragma GCC unroll 16
    for (std::size_t row = 0; row < kRows; ++row) {
        const double weight = weights[row][band];
        if (weight == 0)
            continue;
        const auto w = hn::Set(d, weight);
#pragma GCC unroll 16
        for (std::size_t v = 0; v < kVectors; ++v)
            sums[row][v] = hn::Add(sums[row][v], hn::Mul(w, samples[v]));
    }
}

/// kRows outputs from `first_row` on: as many groups of kVectors vectors as the run has. The last group
/// starts early enough to end with the run: it repeats some pixels, with the same result.
template <std::size_t kRows, std::size_t kVectors>
static void collapse_rows(std::span<const BandView> bands, const WeightMatrix& matrix, std::size_t first_row,
                          std::size_t pixel_count, std::span<float* const> out) {
    constexpr std::size_t kLanes = hn::MaxLanes(Doubles()), kStep = kVectors * kLanes;
    const double* weights[kRows];
    for (std::size_t row = 0; row < kRows; ++row)
        weights[row] = matrix.row(first_row + row).data();
    for (std::size_t next = 0; next < pixel_count; next += kStep) {
        const std::size_t pixel = std::min(next, pixel_count - kStep);
        Sums sums[kRows][kVectors];
#pragma GCC unroll 16
        for (std::size_t row = 0; row < kRows; ++row)
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                sums[row][v] = hn::Zero(Doubles());
        for (std::size_t band = 0; band < bands.size(); ++band) {
            const BandView& view = bands[band];
            if (view.data == nullptr)  // no output needs it, or it is zero
                continue;
            if (view.type == SampleType::Half)
                add_band<kRows, kVectors, true>(view.data + pixel * 2, weights, band, sums);
            else
                add_band<kRows, kVectors, false>(view.data + pixel * 4, weights, band, sums);
        }
#pragma GCC unroll 16
        for (std::size_t row = 0; row < kRows; ++row)
#pragma GCC unroll 16
            for (std::size_t v = 0; v < kVectors; ++v)
                hn::StoreU(hn::DemoteTo(Floats(), sums[row][v]), Floats(),
                           out[first_row + row] + pixel + v * kLanes);
    }
}

/// Some outputs from `first_row` on, for a run of whole groups or more; returns how many outputs.
/// Sums stay in registers: 32 of them with AVX-512, 16 before it.
static std::size_t collapse_groups(std::span<const BandView> bands, const WeightMatrix& matrix,
                                   std::size_t first_row, std::size_t pixel_count,
                                   std::span<float* const> out) {
    constexpr bool kManyRegisters = HWY_TARGET <= HWY_AVX3;
    constexpr std::size_t kOne = kManyRegisters ? 4 : 8, kTwo = 4, kThree = kManyRegisters ? 4 : 3;
    const std::size_t rows = matrix.rows() - first_row;
    const std::size_t vectors = rows == 1 ? kOne : rows == 2 ? kTwo : kThree;
    if (pixel_count < vectors * hn::MaxLanes(Doubles()))
        return 0;
    if (rows == 1)
        return collapse_rows<1, kOne>(bands, matrix, first_row, pixel_count, out), 1;
    if (rows == 2)
        return collapse_rows<2, kTwo>(bands, matrix, first_row, pixel_count, out), 2;
    if (kManyRegisters && rows >= 6)
        return collapse_rows < 6, kManyRegisters ? 4 : 2 > (bands, matrix, first_row, pixel_count, out), 6;
    return collapse_rows<3, kThree>(bands, matrix, first_row, pixel_count, out), 3;
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace osio

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osio {

HWY_EXPORT(collapse_groups);

bool is_vectorisable(const BandView& band) {
    return band.data == nullptr || (band.type != SampleType::Uint && band.contiguous());
}

void collapse_run(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                  std::span<float* const> out) {
    if (!std::all_of(bands.begin(), bands.end(), is_vectorisable))
        return collapse_run_reference(bands, weights, pixel_count, out);
    for (std::size_t row = 0; row < weights.rows();) {
        const std::size_t done = HWY_DYNAMIC_DISPATCH(collapse_groups)(bands, weights, row, pixel_count, out);
        if (done == 0)
            return collapse_rows_reference(bands, weights, row, pixel_count, out);
        row += done;
    }
}

}  // namespace osio
#endif
