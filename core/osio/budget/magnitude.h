// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/band_view.h>
#include <osio/collapse/weights.h>

#include <cstddef>
#include <span>
#include <vector>

/// Sums of absolute values, for bounds on rounding: how large what is added was, whatever cancelled.
namespace osio {

/// Added to every sum: products of floats may underflow, each by less than 2^-149, and more bands than 2^29
/// there are not.
inline constexpr float kMagnitudeUnderflow = 0x1p-120F;

/// What a sample counts for.
enum class SampleMeasure {
    Magnitude,  ///< |s|
    Binade,     ///< the largest power of two that |s| reaches; 0 below 2^-126
};

/// The absolute weights of a matrix as floats, rounded up: a weight that is not zero stays so.
class MagnitudeWeights {
  public:
    MagnitudeWeights() = default;
    explicit MagnitudeWeights(const WeightMatrix& weights);

    [[nodiscard]] std::size_t rows() const { return m_rows; }

    [[nodiscard]] std::size_t bands() const { return m_bands; }

    [[nodiscard]] float at(std::size_t row, std::size_t band) const { return m_values[row * m_bands + band]; }

    [[nodiscard]] float& at(std::size_t row, std::size_t band) { return m_values[row * m_bands + band]; }

    /// What a float sum of this many terms is multiplied by, so that its own rounding does not make it
    /// smaller than the sum it stands for.
    [[nodiscard]] float slack() const;

  private:
    std::size_t m_rows = 0;
    std::size_t m_bands = 0;
    std::vector<float> m_values;
};

/// out[row][pixel] = SUM over bands of weight x measure(sample), not below the true sum and above it by
/// less than (bands + 8) 2^-22 of it and twice kMagnitudeUnderflow. Bands of weight zero are not read. NaN and infinities pass through.
void magnitude_run(std::span<const BandView> bands, const MagnitudeWeights& weights, SampleMeasure measure,
                   std::size_t pixel_count, std::span<float* const> out);

/// The obvious loop in double, then rounded as the other: any stride, any type.
void magnitude_run_reference(std::span<const BandView> bands, const MagnitudeWeights& weights,
                             SampleMeasure measure, std::size_t pixel_count, std::span<float* const> out);

}  // namespace osio
