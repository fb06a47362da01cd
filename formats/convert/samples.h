// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/band_view.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osio::convert {

/// Samples of one type as another. Half to float is exact and float to float the same bits; float to half rounds
/// to nearest, and what exceeds +-65504 becomes +-65504 and is counted; unsigned integers round to 24 bits.
class SampleBuffer {
  public:
    /// `count` contiguous samples of `from` as `to`: the source's own where the types agree. They live until the
    /// next call, or as long as the source's.
    [[nodiscard]] const std::byte* convert(const BandView& from, SampleType to, std::size_t count);

    [[nodiscard]] std::uint64_t clamped() const { return m_clamped; }

  private:
    std::vector<std::byte> m_bytes;
    std::uint64_t m_clamped = 0;
};

}  // namespace osio::convert
