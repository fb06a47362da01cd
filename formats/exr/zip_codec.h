// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;
struct libdeflate_decompressor;

namespace osio::exr {

/// zlib streams to bytes, by libdeflate. One for each worker; memory is reused.
class Inflater {
  public:
    Inflater();
    ~Inflater();
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /// The `unpacked_bytes` that a stream must become; they live until the next call. Damaged where it is
    /// broken, fails its checksum, is shorter or longer than that, or leaves packed bytes over.
    [[nodiscard]] Result<std::span<const std::uint8_t>> inflate(std::span<const std::uint8_t> packed,
                                                                std::size_t unpacked_bytes);

  private:
    struct Free {
        void operator()(libdeflate_decompressor* decompressor) const;
    };

    std::unique_ptr<libdeflate_decompressor, Free> m_inflate;
    std::vector<std::uint8_t> m_bytes;
};

/// Samples to chunks of ZIP and ZIPS. One for each worker; memory is reused.
class ZipEncoder {
  public:
    /// `level` as libdeflate's, 1 to 12.
    explicit ZipEncoder(int level);
    ~ZipEncoder();
    ZipEncoder(const ZipEncoder&) = delete;
    ZipEncoder& operator=(const ZipEncoder&) = delete;

    /// Appends the chunk's packed bytes to `out`; `samples` itself where packing saves nothing.
    void encode(std::span<const std::uint8_t> samples, std::vector<std::uint8_t>& out);

  private:
    struct Free {
        void operator()(libdeflate_compressor* compressor) const;
    };

    std::unique_ptr<libdeflate_compressor, Free> m_deflate;
    std::vector<std::uint8_t> m_zipped;
};

}  // namespace osio::exr
