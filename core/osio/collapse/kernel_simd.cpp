// SPDX-License-Identifier: Apache-2.0
//
// The only file that includes Highway. It is compiled once for each instruction set, with
// -ffp-contract=off: a compiler that fused Add(Mul(...)) would change the last bit.
#include <osio/base/half.h>
#include <osio/collapse/kernel.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "osio/collapse/kernel_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace osio {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kRows = 3;

/// Double vectors kept in registers for each output row.
constexpr std::size_t kVectors = 4;

using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Halves = hn::Rebind<hwy::float16_t, Doubles>;

/// Lanes(d) samples as doubles; `from` is aligned to a sample.
HWY_INLINE hn::Vec<Doubles> load_floats(const std::byte* from) {
    return hn::PromoteTo(Doubles(), hn::LoadU(Floats(), reinterpret_cast<const float*>(from)));
}

HWY_INLINE hn::Vec<Doubles> load_halves(const std::byte* from) {
    const Floats floats;
#if HWY_TARGET <= HWY_AVX2
    // F16C converts every pattern exactly.
    const Halves halves;
    const auto raw = hn::LoadU(halves, reinterpret_cast<const hwy::float16_t*>(from));
    return hn::PromoteTo(Doubles(), hn::PromoteTo(floats, raw));
#else
    // Without F16C Highway's own conversion does not keep infinities and NaN.
    HWY_ALIGN std::array<float, hn::MaxLanes(Floats())> lanes;
    for (std::size_t i = 0; i < hn::Lanes(floats); ++i)
        lanes[i] = float_from_half(reinterpret_cast<const std::uint16_t*>(from)[i]);
    return hn::PromoteTo(Doubles(), hn::Load(floats, lanes.data()));
#endif
}

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128

/// kVectors x Lanes pixels starting at `pixel`; every band contiguous, half or float.
static void collapse_group(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel,
                           std::span<float* const> out) {
    const Doubles d;
    const Floats floats;
    const std::size_t lanes = hn::Lanes(d);
    auto a0 = hn::Zero(d), a1 = a0, a2 = a0, a3 = a0;
    auto b0 = a0, b1 = a0, b2 = a0, b3 = a0;
    auto c0 = a0, c1 = a0, c2 = a0, c3 = a0;
    const double* const row0 = weights.row(0).data();
    const double* const row1 = weights.row(1).data();
    const double* const row2 = weights.row(2).data();
    for (std::size_t band = 0; band < bands.size(); ++band) {
        const double w0 = row0[band], w1 = row1[band], w2 = row2[band];
        if (w0 == 0 && w1 == 0 && w2 == 0)
            continue;
        const BandView& view = bands[band];
        const std::size_t bytes = sample_bytes(view.type);
        const std::byte* const from = view.data + pixel * bytes;
        const bool half = view.type == SampleType::Half;
        const auto load = [&](std::size_t v) HWY_ATTR {
            const std::byte* const at = from + v * lanes * bytes;
            return half ? load_halves(at) : load_floats(at);
        };
        const auto s0 = load(0), s1 = load(1), s2 = load(2), s3 = load(3);
        if (w0 != 0) {
            const auto w = hn::Set(d, w0);
            a0 = hn::Add(a0, hn::Mul(w, s0));
            a1 = hn::Add(a1, hn::Mul(w, s1));
            a2 = hn::Add(a2, hn::Mul(w, s2));
            a3 = hn::Add(a3, hn::Mul(w, s3));
        }
        if (w1 != 0) {
            const auto w = hn::Set(d, w1);
            b0 = hn::Add(b0, hn::Mul(w, s0));
            b1 = hn::Add(b1, hn::Mul(w, s1));
            b2 = hn::Add(b2, hn::Mul(w, s2));
            b3 = hn::Add(b3, hn::Mul(w, s3));
        }
        if (w2 != 0) {
            const auto w = hn::Set(d, w2);
            c0 = hn::Add(c0, hn::Mul(w, s0));
            c1 = hn::Add(c1, hn::Mul(w, s1));
            c2 = hn::Add(c2, hn::Mul(w, s2));
            c3 = hn::Add(c3, hn::Mul(w, s3));
        }
    }
    const auto store = [&](std::size_t row, auto v0, auto v1, auto v2, auto v3) HWY_ATTR {
        float* const to = out[row] + pixel;
        hn::StoreU(hn::DemoteTo(floats, v0), floats, to);
        hn::StoreU(hn::DemoteTo(floats, v1), floats, to + lanes);
        hn::StoreU(hn::DemoteTo(floats, v2), floats, to + 2 * lanes);
        hn::StoreU(hn::DemoteTo(floats, v3), floats, to + 3 * lanes);
    };
    store(0, a0, a1, a2, a3);
    store(1, b0, b1, b2, b3);
    store(2, c0, c1, c2, c3);
}

#endif

/// Whole groups of a run; returns how many pixels were done.
static std::size_t collapse_groups(std::span<const BandView> bands, const WeightMatrix& weights,
                                   std::size_t pixel_count, std::span<float* const> out) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
    // Highway's emulation turns infinities into the largest float. Leave all to the reference.
    (void)bands, (void)weights, (void)pixel_count, (void)out;
    return 0;
#else
    const std::size_t step = kVectors * hn::Lanes(Doubles());
    std::size_t pixel = 0;
    for (; pixel + step <= pixel_count; pixel += step)
        collapse_group(bands, weights, pixel, out);
    return pixel;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace osio

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osio {

HWY_EXPORT(collapse_groups);

namespace {

bool vectorisable(const BandView& band) {
    const auto address = reinterpret_cast<std::uintptr_t>(band.data);
    return band.data == nullptr ||
           (band.type != SampleType::Uint && band.contiguous() && address % sample_bytes(band.type) == 0);
}

}  // namespace

void collapse_run(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                  std::span<float* const> out) {
    std::size_t done = 0;
    if (weights.rows() == 3 && std::all_of(bands.begin(), bands.end(), vectorisable))
        done = HWY_DYNAMIC_DISPATCH(collapse_groups)(bands, weights, pixel_count, out);
    if (done == pixel_count)
        return;
    std::vector<BandView> rest_bands;
    for (const BandView& band : bands)
        rest_bands.push_back(band.advanced(done));
    std::vector<float*> rest_out;
    for (float* row : out)
        rest_out.push_back(row + done);
    collapse_run_reference(rest_bands, weights, pixel_count - done, rest_out);
}

}  // namespace osio
#endif
