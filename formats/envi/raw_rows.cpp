// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/raw_rows.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace osio::envi {

namespace {

/// Bytes that are read at once of one band.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 22;

/// Copies `count` numbers of `Bytes` bytes, `from_step` and `to_step` numbers apart.
template <std::size_t Bytes, bool swapped>
void copy(const std::byte* from, std::size_t from_step, std::byte* to, std::size_t to_step,
          std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, from += from_step * Bytes, to += to_step * Bytes) {
        if constexpr (swapped)
            std::reverse_copy(from, from + Bytes, to);
        else
            std::memcpy(to, from, Bytes);
    }
}

using Copy = void (*)(const std::byte*, std::size_t, std::byte*, std::size_t, std::size_t);

Copy copier(std::size_t bytes, bool swapped) {
    switch (bytes) {
    case 1: return copy<1, false>;
    case 2: return swapped ? copy<2, true> : copy<2, false>;
    case 4: return swapped ? copy<4, true> : copy<4, false>;
    default: return swapped ? copy<8, true> : copy<8, false>;
    }
}

}  // namespace

Result<void> read_raw_rows(const EnviFile& file, RowRange rows, std::span<const std::size_t> bands,
                           std::byte* out) {
    const EnviHeader& header = file.header();
    const std::size_t bytes = data_bytes(header.type);
    const Copy copy_numbers = copier(bytes, header.big_endian != (std::endian::native == std::endian::big));
    const auto first = static_cast<std::uint64_t>(rows.first);
    const auto end = static_cast<std::uint64_t>(rows.last) + 1;
    const std::uint64_t row_numbers = header.samples * bands.size();
    std::string buffer;
    const auto fetch = [&](std::uint64_t n, std::uint64_t count) -> Result<void> {
        auto result = file.data().read(header.header_offset + n * bytes, count * bytes, buffer);
        return result ? Result<void>() : fail_in(file.data_path(), result.error());
    };
    const auto numbers = [&buffer, bytes](std::uint64_t n) {
        return reinterpret_cast<const std::byte*>(buffer.data()) + n * bytes;
    };

    if (header.interleave == Interleave::Bsq) {
        const std::uint64_t step = std::max<std::uint64_t>(1, kMostBytes / (header.samples * bytes));
        for (std::uint64_t row = first; row < end; row += step) {
            const std::uint64_t count = std::min(step, end - row) * header.samples;
            for (std::size_t i = 0; i < bands.size(); ++i) {
                OSIO_CHECK_OK(fetch((bands[i] * header.lines + row) * header.samples, count));
                copy_numbers(numbers(0), 1, out + ((row - first) * row_numbers + i) * bytes, bands.size(),
                             count);
            }
        }
        return {};
    }
    const bool by_pixel = header.interleave == Interleave::Bip;
    const std::uint64_t line = header.samples * header.bands;
    for (std::uint64_t row = first; row < end; ++row) {
        OSIO_CHECK_OK(fetch(row * line, line));
        for (std::size_t i = 0; i < bands.size(); ++i)
            copy_numbers(numbers(by_pixel ? bands[i] : bands[i] * header.samples),
                         by_pixel ? header.bands : 1, out + ((row - first) * row_numbers + i) * bytes,
                         bands.size(), header.samples);
    }
    return {};
}

}  // namespace osio::envi
