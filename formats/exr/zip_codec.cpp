// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/zip_bytes.h>
#include <formats/exr/zip_codec.h>

#include <algorithm>
#include <libdeflate.h>
#include <new>
#include <string>

namespace osio::exr {

void Inflater::Free::operator()(libdeflate_decompressor* decompressor) const {
    libdeflate_free_decompressor(decompressor);
}

Inflater::Inflater() : m_inflate(libdeflate_alloc_decompressor()) {
    if (m_inflate == nullptr)
        throw std::bad_alloc();
}

Inflater::~Inflater() = default;

Result<std::span<const std::uint8_t>> Inflater::inflate(std::span<const std::uint8_t> packed,
                                                        std::size_t unpacked_bytes) {
    m_bytes.resize(unpacked_bytes);
    std::size_t used = 0;
    // Without a place for the size libdeflate demands that the output is filled exactly.
    const auto outcome = libdeflate_zlib_decompress_ex(m_inflate.get(), packed.data(), packed.size(),
                                                       m_bytes.data(), unpacked_bytes, &used, nullptr);
    if (outcome == LIBDEFLATE_SHORT_OUTPUT || outcome == LIBDEFLATE_INSUFFICIENT_SPACE)
        return fail(ErrorCode::Damaged, std::string("a chunk unpacks to ") +
                                            (outcome == LIBDEFLATE_SHORT_OUTPUT ? "fewer" : "more") +
                                            " bytes than the expected " + std::to_string(unpacked_bytes));
    if (outcome != LIBDEFLATE_SUCCESS)
        return fail(ErrorCode::Damaged, "a chunk's packed bytes or their checksum are wrong");
    if (used != packed.size())
        return fail(ErrorCode::Damaged, "a chunk ends " + std::to_string(packed.size() - used) +
                                            " bytes before its packed size says");
    return m_bytes;
}

void ZipEncoder::Free::operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
}

ZipEncoder::ZipEncoder(int level) : m_deflate(libdeflate_alloc_compressor(level)) {
    if (m_deflate == nullptr)
        throw std::bad_alloc();
}

ZipEncoder::~ZipEncoder() = default;

void ZipEncoder::encode(std::span<const std::uint8_t> samples, std::vector<std::uint8_t>& out) {
    m_zipped.resize(samples.size());
    zip(samples, m_zipped.data());
    const std::size_t start = out.size();
    out.resize(start + samples.size());
    // A chunk as large as its samples is one that is stored: packing must save a byte.
    const std::size_t packed =
        samples.empty() ? 0
                        : libdeflate_zlib_compress(m_deflate.get(), m_zipped.data(), m_zipped.size(),
                                                   out.data() + start, samples.size() - 1);
    if (packed != 0)
        out.resize(start + packed);
    else
        std::copy(samples.begin(), samples.end(), out.begin() + static_cast<std::ptrdiff_t>(start));
}

}  // namespace osio::exr
