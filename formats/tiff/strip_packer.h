// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

struct libdeflate_compressor;

namespace osio::tiff {

/// Floats to the bytes of a strip of one sample, deflated behind TIFF's predictor 3 for floats: of each row the bytes of
/// equal rank together, the highest first, each as its difference from the one before (Adobe Photoshop TIFF
/// Technical Note 3, 2005). One for each worker; memory is reused.
class StripPacker {
  public:
    StripPacker();
    ~StripPacker();
    StripPacker(const StripPacker&) = delete;
    StripPacker& operator=(const StripPacker&) = delete;

    /// Appends the packed strip to `out`; how many bytes it takes.
    std::size_t pack(const float* samples, std::size_t width, std::size_t rows, std::vector<std::byte>& out);

  private:
    struct Free {
        void operator()(libdeflate_compressor* compressor) const;
    };

    std::unique_ptr<libdeflate_compressor, Free> m_deflate;
    std::vector<std::uint8_t> m_bytes;
};

}  // namespace osio::tiff
