// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/zip_bytes.h>

namespace osio::exr {

UnzipCursor start_unzip_reference(std::span<const std::uint8_t> zipped) {
    const std::size_t half = zipped.size() / 2;
    UnzipCursor cursor{zipped.data(), zipped.data() + half, 128, 128};
    for (std::size_t i = 0; i < half; ++i)
        cursor.odd_before = static_cast<std::uint8_t>(cursor.odd_before + zipped[i] - 128);
    return cursor;
}

void unzip_reference(UnzipCursor& cursor, std::span<std::uint8_t> out) {
    for (std::size_t i = 0; i + 1 < out.size(); i += 2) {
        cursor.even_before = static_cast<std::uint8_t>(cursor.even_before + *cursor.even++ - 128);
        cursor.odd_before = static_cast<std::uint8_t>(cursor.odd_before + *cursor.odd++ - 128);
        out[i] = cursor.even_before;
        out[i + 1] = cursor.odd_before;
    }
}

void zip_reference(std::span<const std::uint8_t> bytes, std::uint8_t* out) {
    const std::size_t half = bytes.size() / 2;
    std::uint8_t before = 128;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const std::uint8_t byte = i < half ? bytes[2 * i] : bytes[2 * (i - half) + 1];
        out[i] = static_cast<std::uint8_t>(byte - before + 128);
        before = byte;
    }
}

}  // namespace osio::exr
