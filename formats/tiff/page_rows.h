// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/tiff/tiff_file.h>

#include <cstdint>
#include <span>
#include <vector>

namespace osio::tiff {

/// A sample of a page, and where its floats go: rows of the page's width from `to` on.
struct WantedSample {
    std::uint16_t sample = 0;
    const image::Scaling* scaling = nullptr;
    float* to = nullptr;
};

/// Reads rows of one page after another, for one thread.
class PageRows {
  public:
    explicit PageRows(std::unique_ptr<Handle> handle) : m_handle(std::move(handle)) {}

    /// Rows `first` to `first + count - 1`. Damaged where the file ends before, a strip or tile does not unpack to what
    /// it must be, or libtiff has a word to say about it.
    [[nodiscard]] Result<void> read(const Page& page, std::uint32_t first, std::uint32_t count,
                                    std::span<const WantedSample> wanted);

  private:
    /// A strip or tile: which one, and the part of the page that it covers.
    struct Block {
        std::uint32_t index = 0;
        std::uint32_t row = 0, rows = 0;        ///< rows of the page; of an edge tile fewer than it stores
        std::uint32_t column = 0, columns = 0;  ///< the same
    };

    [[nodiscard]] Result<void> read_plain(const Page& page, const Block& block, std::uint32_t first,
                                          std::uint32_t count, std::span<const WantedSample> wanted);
    [[nodiscard]] Result<void> read_packed(const Page& page, const Block& block, std::uint32_t first,
                                           std::uint32_t count, std::span<const WantedSample> wanted);

    std::unique_ptr<Handle> m_handle;
    std::vector<std::byte> m_bytes;
};

}  // namespace osio::tiff
