// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osio::convert {

/// Samples of one type as another. Half to float is exact and float to float the same bits; float to half rounds
/// to nearest, and what exceeds +-65504 becomes +-65504 and is counted; unsigned integers round to 24 bits.
class SampleBuffer {
  public:
    /// The samples of a plane as `to`, row after row: the block's own where they are so already. They live until
    /// the next call, or as long as the block's.
    [[nodiscard]] const std::byte* convert(const PlanarBlock& block, std::size_t plane, SampleType to);

    [[nodiscard]] std::uint64_t clamped() const { return m_clamped; }

  private:
    void convert_run(const BandView& from, SampleType to, std::size_t first, std::size_t count);

    std::vector<std::byte> m_bytes;
    std::uint64_t m_clamped = 0;
};

}  // namespace osio::convert
