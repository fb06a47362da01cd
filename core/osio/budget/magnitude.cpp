// SPDX-License-Identifier: Apache-2.0
#include <osio/budget/magnitude.h>
#include <osio/collapse/kernel.h>

#include <cmath>
#include <limits>

namespace osio {

namespace {

float rounded_up(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value
               ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}

double measured(double sample, SampleMeasure measure) {
    const double magnitude = std::abs(sample);
    if (measure == SampleMeasure::Magnitude || !std::isfinite(magnitude))
        return magnitude;
    return magnitude < 0x1p-126 ? 0 : std::exp2(std::ilogb(magnitude));
}

}  // namespace

MagnitudeWeights::MagnitudeWeights(const WeightMatrix& weights)
    : m_rows(weights.rows()), m_bands(weights.bands()), m_values(m_rows * m_bands) {
    for (std::size_t row = 0; row < m_rows; ++row)
        for (std::size_t band = 0; band < m_bands; ++band)
            at(row, band) = rounded_up(std::abs(weights.at(row, band)));
}

float MagnitudeWeights::slack() const {
    // A sum of n terms, products included, is (1 + d) times the true one with |d| <= n u / (1 - n u)
    // (Higham, Accuracy and Stability of Numerical Algorithms, 2002, 3.1), u = 2^-24.
    return static_cast<float>(1 + static_cast<double>(m_bands + 4) * 0x1p-23);
}

void magnitude_run_reference(std::span<const BandView> bands, const MagnitudeWeights& weights,
                             SampleMeasure measure, std::size_t pixel_count, std::span<float* const> out) {
    for (std::size_t row = 0; row < weights.rows(); ++row) {
        for (std::size_t pixel = 0; pixel < pixel_count; ++pixel) {
            double sum = 0;
            for (std::size_t band = 0; band < bands.size(); ++band)
                if (const float weight = weights.at(row, band); weight != 0)
                    sum += static_cast<double>(weight) * measured(sample_at(bands[band], pixel), measure);
            out[row][pixel] = rounded_up(sum + static_cast<double>(kMagnitudeUnderflow));
        }
    }
}

}  // namespace osio
