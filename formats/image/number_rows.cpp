// SPDX-License-Identifier: Apache-2.0
#include <formats/image/number_rows.h>

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace osio::image {

namespace {

/// A number of type T at any address, its bytes in either order.
template <class T, bool swapped>
T load(const std::byte* from) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if constexpr (swapped)
        std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

/// Rounds to the nearest float, beyond the largest to infinity: the cast alone promises no such thing.
float rounded(double value) {
    constexpr double kMost = std::numeric_limits<float>::max();
    if (std::abs(value) > kMost && std::isfinite(value)) {
        // Halfway between the largest float and the next one, 2^128 - 2^103, rounding changes sides.
        constexpr double kHalfway = 0x1.ffffffp127;
        const float out = std::abs(value) < kHalfway ? std::numeric_limits<float>::max()
                                                     : std::numeric_limits<float>::infinity();
        return value < 0 ? -out : out;
    }
    return static_cast<float>(value);
}

template <class T, bool swapped>
void convert(const std::byte* from, std::size_t step, std::size_t count, const Scaling& scaling, float* to) {
    if (scaling.identity()) {
        for (std::size_t i = 0; i < count; ++i, from += step) {
            const T number = load<T, swapped>(from);
            if constexpr (std::is_same_v<T, double>)
                to[i] = rounded(number);
            else if constexpr (std::is_same_v<T, float>)
                to[i] = number;
            else
                to[i] = static_cast<float>(number);
        }
        return;
    }
    for (std::size_t i = 0; i < count; ++i, from += step)
        to[i] = rounded(scaling.apply(static_cast<double>(load<T, swapped>(from))));
}

using Convert = void (*)(const std::byte*, std::size_t, std::size_t, const Scaling&, float*);

template <class T>
Convert choose(bool swapped) {
    return swapped ? &convert<T, true> : &convert<T, false>;
}

Convert converter(NumberType type, bool swapped) {
    switch (type) {
    case NumberType::Uint8: return choose<std::uint8_t>(false);
    case NumberType::Int8: return choose<std::int8_t>(false);
    case NumberType::Uint16: return choose<std::uint16_t>(swapped);
    case NumberType::Int16: return choose<std::int16_t>(swapped);
    case NumberType::Uint32: return choose<std::uint32_t>(swapped);
    case NumberType::Int32: return choose<std::int32_t>(swapped);
    case NumberType::Uint64: return choose<std::uint64_t>(swapped);
    case NumberType::Int64: return choose<std::int64_t>(swapped);
    case NumberType::Half: return choose<Imath::half>(swapped);
    case NumberType::Float: return choose<float>(swapped);
    case NumberType::Double: break;
    }
    return choose<double>(swapped);
}

constexpr std::array<std::string_view, 11> kNames{"uint8",  "int8",  "uint16", "int16", "uint32", "int32",
                                                  "uint64", "int64", "half",   "float", "double"};

}  // namespace

std::string_view number_name(NumberType type) {
    return kNames[static_cast<std::size_t>(type)];
}

std::string rounding_warning(NumberType type) {
    return "numbers are " + std::string(number_name(type)) + ": they are rounded to float, 24 bits";
}

double Scaling::apply(double number) const {
    if (ignore && number == *ignore)
        return std::numeric_limits<double>::quiet_NaN();
    return (number * gain + offset) / divisor;
}

void to_floats(const std::byte* from, std::size_t stride, std::size_t count, NumberType type, bool big_endian,
               const Scaling& scaling, float* to) {
    const bool swapped = big_endian != (std::endian::native == std::endian::big);
    converter(type, swapped)(from, stride * number_bytes(type), count, scaling, to);
}

}  // namespace osio::image
