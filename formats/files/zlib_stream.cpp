// SPDX-License-Identifier: Apache-2.0
#include <formats/files/zlib_stream.h>

#include <libdeflate.h>
#include <memory>
#include <new>

namespace osio::files {

std::string zlib_stream_of(std::span<const std::uint8_t> bytes) {
    constexpr int kLevel = 9;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
    if (compressor == nullptr)
        throw std::bad_alloc();
    std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    out.resize(
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
    return out;
}

}  // namespace osio::files
