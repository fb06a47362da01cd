// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>

#include <array>
#include <cstdint>
#include <span>

/// The start of an OpenEXR file whose chunks are written by ourselves (OpenEXR's "File Layout").
namespace osio::exr {

/// A number in as many bytes as its type has, the lowest first. Throws what the stream throws.
template <class Number>
void write_number(Imf::OStream& stream, Number value) {
    std::array<char, sizeof(Number)> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF);
    stream.write(bytes.data(), static_cast<int>(bytes.size()));
}

/// Magic number, version and flags, and the headers of parts, of scanlines or tiles; the tables of chunks follow.
/// Headers of several parts must have name, type and number of chunks. Throws what the stream throws,
/// and std::exception for a header that OpenEXR does not allow.
void write_headers(Imf::OStream& stream, std::span<const Imf::Header> headers);

}  // namespace osio::exr
