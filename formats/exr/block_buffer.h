// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_source.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace osio::exr {

/// The memory of one block: a plane of rows x width samples for each wanted channel. Made once a
/// reader and used again for every block: fresh pages cost as much as half a decode.
class BlockBuffer {
  public:
    BlockBuffer(const image::Part& part, const PlaneChannels& planes, const BlockGrid& grid);

    /// Bytes that a buffer for such blocks takes.
    [[nodiscard]] static std::uint64_t bytes_needed(const image::Part& part, const PlaneChannels& planes,
                                                    const BlockGrid& grid);

    /// Where a plane starts; null for a plane that nobody reads.
    [[nodiscard]] std::byte* plane(std::size_t plane) { return m_planes[plane]; }

    /// The planes as a block.
    [[nodiscard]] PlanarBlock block(int first_row, int row_count) const;

  private:
    int m_width;
    std::vector<std::byte> m_memory;
    std::vector<std::byte*> m_planes;
    std::vector<SampleType> m_types;
};

}  // namespace osio::exr
