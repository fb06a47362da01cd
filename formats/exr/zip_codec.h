// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/zip_bytes.h>

#include <osio/base/result.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;
struct libdeflate_decompressor;

namespace osio::exr {

/// Chunks of ZIP and ZIPS to samples, by libdeflate. One for each worker; memory is reused.
class ZipDecoder {
  public:
    ZipDecoder();
    ~ZipDecoder();
    ZipDecoder(const ZipDecoder&) = delete;
    ZipDecoder& operator=(const ZipDecoder&) = delete;

    /// Takes a chunk that must become `unpacked_bytes`, an even number. As many packed bytes are a
    /// chunk that was stored as it is. Damaged where the stream is broken, fails its checksum, is
    /// shorter or longer than that, or leaves packed bytes over. `packed` must outlive next()'s calls.
    [[nodiscard]] Result<void> start(std::span<const std::uint8_t> packed, std::size_t unpacked_bytes);

    /// The next bytes of the chunk, an even number.
    void next(std::span<std::uint8_t> out);

  private:
    struct Free {
        void operator()(libdeflate_decompressor* decompressor) const;
    };

    std::unique_ptr<libdeflate_decompressor, Free> m_inflate;
    std::vector<std::uint8_t> m_zipped;
    UnzipCursor m_cursor;
    const std::uint8_t* m_stored = nullptr;  ///< the next byte of a chunk stored as it is
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
