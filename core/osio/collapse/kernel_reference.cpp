// SPDX-License-Identifier: Apache-2.0
//
// Compiled with -ffp-contract=off: weight x sample is rounded before it is added.
#include <osio/base/half.h>
#include <osio/collapse/kernel.h>

#include <cstring>

namespace osio {

double sample_at(const BandView& band, std::size_t pixel) {
    const std::byte* at = band.data + static_cast<std::ptrdiff_t>(pixel) * band.pixel_stride_bytes;
    switch (band.type) {
    case SampleType::Half: {
        std::uint16_t bits = 0;
        std::memcpy(&bits, at, sizeof bits);
        return static_cast<double>(float_from_half(bits));
    }
    case SampleType::Float: {
        float value = 0;
        std::memcpy(&value, at, sizeof value);
        return static_cast<double>(value);
    }
    case SampleType::Uint: break;
    }
    std::uint32_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

bool is_zero(const BandView& band, std::size_t pixel_count) {
    if (band.data == nullptr || !band.contiguous() || pixel_count == 0)
        return false;
    const std::size_t bytes = pixel_count * sample_bytes(band.type);
    constexpr std::byte kZero{};
    // All bytes are the first where each is the next.
    return band.data[0] == kZero && band.data[bytes - 1] == kZero &&
           std::memcmp(band.data, band.data + 1, bytes - 1) == 0;
}

void collapse_run_reference(std::span<const BandView> bands, const WeightMatrix& weights,
                            std::size_t pixel_count, std::span<float* const> out) {
    collapse_rows_reference(bands, weights, 0, pixel_count, out);
}

void collapse_rows_reference(std::span<const BandView> bands, const WeightMatrix& weights,
                             std::size_t first_row, std::size_t pixel_count, std::span<float* const> out) {
    for (std::size_t row = first_row; row < weights.rows(); ++row) {
        for (std::size_t pixel = 0; pixel < pixel_count; ++pixel) {
            double sum = 0;
            for (std::size_t band = 0; band < bands.size(); ++band) {
                const double weight = weights.at(row, band);
                if (weight != 0 && bands[band].data != nullptr)
                    sum += weight * sample_at(bands[band], pixel);
            }
            out[row][pixel] = static_cast<float>(sum);
        }
    }
}

}  // namespace osio
