// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_header.h>

#include <cstddef>
#include <optional>

namespace osio::envi {

/// How the numbers of one band become samples.
struct Scaling {
    double gain = 1, offset = 0, divisor = 1;
    std::optional<double> ignore;

    /// Of a band of a header.
    [[nodiscard]] static Scaling of(const EnviHeader& header, std::size_t band);

    /// (number * gain + offset) / divisor; NaN for what is to be ignored.
    [[nodiscard]] double apply(double number) const;

    /// True where every number is itself.
    [[nodiscard]] bool identity() const { return gain == 1 && offset == 0 && divisor == 1 && !ignore; }
};

/// `count` stored numbers, `stride` numbers apart, as floats: scaled in double, rounded once. Numbers that a
/// float holds stay exact where the scaling is the identity, and floats keep their bits. `from` needs no
/// alignment.
void to_floats(const std::byte* from, std::size_t stride, std::size_t count, DataType type, bool big_endian,
               const Scaling& scaling, float* to);

}  // namespace osio::envi
