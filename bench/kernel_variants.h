// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/band_view.h>
#include <osio/collapse/weights.h>

#include <cstddef>
#include <span>

/// Other ways to make the sums of collapse_run(), for comparison: three outputs of contiguous half or float
/// samples, in runs of whole vectors.
namespace osio::bench {

/// In double by fused multiply-add. The same bits as the product's with weights of 29 bits, whose products
/// with half or float samples are exact.
void collapse_fused(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                    std::span<float* const> out);

/// In float by fused multiply-add, band after band over the whole run.
void collapse_float(std::span<const BandView> bands, const WeightMatrix& weights, std::size_t pixel_count,
                    std::span<float* const> out);

}  // namespace osio::bench
