// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace osio::image {

/// How a file stores a number.
enum class NumberType : std::uint8_t {
    Uint8,
    Int8,
    Uint16,
    Int16,
    Uint32,
    Int32,
    Uint64,
    Int64,
    Half,
    Float,
    Double,
};

[[nodiscard]] constexpr std::size_t number_bytes(NumberType type) {
    switch (type) {
    case NumberType::Uint8:
    case NumberType::Int8: return 1;
    case NumberType::Uint16:
    case NumberType::Int16:
    case NumberType::Half: return 2;
    case NumberType::Uint32:
    case NumberType::Int32:
    case NumberType::Float: return 4;
    default: return 8;
    }
}

/// "uint8", "int16", ..., "half", "float", "double".
[[nodiscard]] std::string_view number_name(NumberType type);

[[nodiscard]] constexpr bool is_float(NumberType type) {
    return type == NumberType::Half || type == NumberType::Float || type == NumberType::Double;
}

/// True where a float cannot hold every number of the type.
[[nodiscard]] constexpr bool rounds_to_float(NumberType type) {
    return type == NumberType::Double || (number_bytes(type) >= 4 && type != NumberType::Float);
}

/// What is said of such numbers.
[[nodiscard]] std::string rounding_warning(NumberType type);

/// How the numbers of one band become samples.
struct Scaling {
    double gain = 1, offset = 0, divisor = 1;
    std::optional<double> ignore;

    /// (number * gain + offset) / divisor; NaN for what is to be ignored.
    [[nodiscard]] double apply(double number) const;

    /// True where every number is itself.
    [[nodiscard]] bool identity() const { return gain == 1 && offset == 0 && divisor == 1 && !ignore; }
};

/// `count` stored numbers, `stride` numbers apart, as floats: scaled in double, rounded once. Numbers that a
/// float holds stay exact where the scaling is the identity, and floats keep their bits. `from` needs no
/// alignment.
void to_floats(const std::byte* from, std::size_t stride, std::size_t count, NumberType type, bool big_endian,
               const Scaling& scaling, float* to);

}  // namespace osio::image
