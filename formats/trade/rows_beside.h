// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

#include <memory>
#include <span>
#include <vector>

namespace osio::trade {

/// Any rows of an image as floats, whatever its blocks are: for one worker that goes over another image of the same
/// size.
class RowsBeside {
  public:
    explicit RowsBeside(const BlockSource& source) : m_source(source) {}

    /// The samples, planes without gaps; they live until the next call. The errors of reading.
    [[nodiscard]] Result<std::span<const BandView>> read(RowRange rows);

  private:
    const BlockSource& m_source;
    std::unique_ptr<BlockReader> m_reader;
    std::vector<std::vector<float>> m_planes;
    std::vector<BandView> m_views;
};

}  // namespace osio::trade
