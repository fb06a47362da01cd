// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/samples.h>

#include <Imath/half.h>

#include <cmath>
#include <cstring>

namespace osio::convert {

namespace {

constexpr float kHalfMax = 65504.0F;

template <class T>
T load(const std::byte* from) {
    T out;
    std::memcpy(&out, from, sizeof(T));
    return out;
}

float as_float(const std::byte* from, SampleType type) {
    switch (type) {
    case SampleType::Half: {
        Imath::half half;
        half.setBits(load<std::uint16_t>(from));
        return half;
    }
    case SampleType::Float: return load<float>(from);
    case SampleType::Uint: break;
    }
    return static_cast<float>(load<std::uint32_t>(from));
}

}  // namespace

const std::byte* SampleBuffer::convert(const PlanarBlock& block, std::size_t plane, SampleType to) {
    const BandView& from = block.planes[plane];
    if (from.type == to && from.contiguous() && block.row_pitch_bytes == 0)
        return from.data;
    m_bytes.resize(static_cast<std::size_t>(block.row_count) * static_cast<std::size_t>(block.width) *
                   sample_bytes(to));
    block.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
        convert_run(planes[plane], to, first, count);
    });
    return m_bytes.data();
}

void SampleBuffer::convert_run(const BandView& from, SampleType to, std::size_t first, std::size_t count) {
    const std::size_t bytes = sample_bytes(to);
    if (from.type == to && from.contiguous()) {
        std::memcpy(m_bytes.data() + first * bytes, from.data, count * bytes);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        float value =
            as_float(from.data + static_cast<std::ptrdiff_t>(i) * from.pixel_stride_bytes, from.type);
        if (to == SampleType::Float) {
            std::memcpy(m_bytes.data() + (first + i) * bytes, &value, sizeof value);
            continue;
        }
        if (std::abs(value) > kHalfMax) {
            value = std::copysign(kHalfMax, value);
            ++m_clamped;
        }
        const std::uint16_t half = Imath::half(value).bits();
        std::memcpy(m_bytes.data() + (first + i) * bytes, &half, sizeof half);
    }
}

}  // namespace osio::convert
