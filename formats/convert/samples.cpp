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

const std::byte* SampleBuffer::convert(const BandView& from, SampleType to, std::size_t count) {
    if (from.type == to && from.contiguous())
        return from.data;
    const std::size_t bytes = sample_bytes(to);
    m_bytes.resize(count * bytes);
    for (std::size_t i = 0; i < count; ++i) {
        float value =
            as_float(from.data + static_cast<std::ptrdiff_t>(i) * from.pixel_stride_bytes, from.type);
        if (to == SampleType::Float) {
            std::memcpy(m_bytes.data() + i * bytes, &value, sizeof value);
            continue;
        }
        if (std::abs(value) > kHalfMax) {
            value = std::copysign(kHalfMax, value);
            ++m_clamped;
        }
        const std::uint16_t half = Imath::half(value).bits();
        std::memcpy(m_bytes.data() + i * bytes, &half, sizeof half);
    }
    return m_bytes.data();
}

}  // namespace osio::convert
