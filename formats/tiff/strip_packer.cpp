// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/strip_packer.h>

#include <bit>
#include <cstring>
#include <libdeflate.h>
#include <new>

namespace osio::tiff {

namespace {

/// zlib's default, and libtiff's.
constexpr int kLevel = 6;

}  // namespace

void StripPacker::Free::operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
}

StripPacker::StripPacker() : m_deflate(libdeflate_alloc_compressor(kLevel)) {
    if (!m_deflate)
        throw std::bad_alloc();
}

StripPacker::~StripPacker() = default;

std::size_t StripPacker::pack(const float* samples, std::size_t width, std::size_t rows,
                              std::vector<std::byte>& out) {
    m_bytes.resize(width * rows * sizeof(float));
    for (std::size_t row = 0; row < rows; ++row) {
        std::uint8_t* const bytes = m_bytes.data() + row * width * sizeof(float);
        for (std::size_t x = 0; x < width; ++x) {
            const auto bits = std::bit_cast<std::uint32_t>(samples[row * width + x]);
            for (std::size_t rank = 0; rank < sizeof(float); ++rank)
                bytes[rank * width + x] = static_cast<std::uint8_t>(bits >> (24 - 8 * rank));
        }
        for (std::size_t i = width * sizeof(float); i-- > 1;)
            bytes[i] = static_cast<std::uint8_t>(bytes[i] - bytes[i - 1]);
    }
    const std::size_t before = out.size();
    out.resize(before + libdeflate_zlib_compress_bound(m_deflate.get(), m_bytes.size()));
    const std::size_t packed = libdeflate_zlib_compress(m_deflate.get(), m_bytes.data(), m_bytes.size(),
                                                        out.data() + before, out.size() - before);
    out.resize(before + packed);
    return packed;
}

}  // namespace osio::tiff
