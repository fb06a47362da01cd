// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace osio {

/// How a sample is stored; the three pixel types of OpenEXR.
enum class SampleType : std::uint8_t { Half, Float, Uint };

[[nodiscard]] constexpr std::size_t sample_bytes(SampleType type) {
    return type == SampleType::Half ? 2 : 4;
}

/// "half", "float", "uint".
[[nodiscard]] constexpr std::string_view sample_type_name(SampleType type) {
    switch (type) {
    case SampleType::Half: return "half";
    case SampleType::Float: return "float";
    case SampleType::Uint: break;
    }
    return "uint";
}

/// The samples of one band along a run of pixels. Owns nothing. `data` may be null for a band that no output
/// needs or that is zero all along the run; samples need no alignment.
struct BandView {
    const std::byte* data = nullptr;
    SampleType type = SampleType::Float;
    std::ptrdiff_t pixel_stride_bytes = 0;

    [[nodiscard]] bool contiguous() const {
        return pixel_stride_bytes == static_cast<std::ptrdiff_t>(sample_bytes(type));
    }

    /// The view `pixels` further along.
    [[nodiscard]] BandView advanced(std::size_t pixels) const {
        if (data == nullptr)
            return *this;
        return {data + static_cast<std::ptrdiff_t>(pixels) * pixel_stride_bytes, type, pixel_stride_bytes};
    }
};

}  // namespace osio
