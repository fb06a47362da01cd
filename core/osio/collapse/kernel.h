// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/band_view.h>
#include <osio/collapse/weights.h>

#include <cstddef>
#include <span>

/// The sum over bands, for a run of pixels: out[row][pixel] = sum over bands of weight x sample.
///
/// Every executor computes the same thing to the last bit: each product and each sum is rounded to
/// double (no fused multiply-add), bands are added in order from +0, bands of weight zero are left
/// out of a row, and the sum is rounded once to float. So the result does not depend on the
/// instruction set, the length of the run or where it starts.
namespace osio {

/// The obvious double loop: the truth that the others are tested against. Any stride, any type.
void collapse_run_reference(std::span<const BandView> bands, const WeightMatrix& weights,
                            std::size_t pixel_count, std::span<float* const> out);

/// The same for the outputs from `first_row` on.
void collapse_rows_reference(std::span<const BandView> bands, const WeightMatrix& weights,
                             std::size_t first_row, std::size_t pixel_count, std::span<float* const> out);

/// The same, in SIMD for contiguous half and float samples and any number of outputs, on the widest
/// instruction set of this machine; by the reference for other samples and for runs shorter than a
/// few vectors.
void collapse_run(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                  std::span<float* const> out);

/// True for what SIMD can load: contiguous halves and floats, and a band that nobody needs.
[[nodiscard]] bool is_vectorisable(const BandView& band);

/// True where all samples of a run are +0, every bit of them. Leaving such a band out changes no bit of any sum: sums
/// begin at +0, and +0 added to anything but -0, which no sum from +0 can be, is that thing itself. A band that does not
/// lie together is not looked at. Costs nothing where the first or the last sample is another number.
[[nodiscard]] bool is_zero(const BandView& band, std::size_t pixel_count);

/// One sample as a double.
[[nodiscard]] double sample_at(const BandView& band, std::size_t pixel);

}  // namespace osio
