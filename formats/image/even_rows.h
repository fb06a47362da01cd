// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

#include <algorithm>

namespace osio::image {

/// The blocks of an image whose file can be read by any rows: as many rows in each, but in the last.
class EvenRows : public BlockSource {
  public:
    /// Blocks of about this many bytes are worth a worker's while, and small beside the image.
    static constexpr std::uint64_t kBlockBytes = std::uint64_t{1} << 22;

    EvenRows(int width, int height, int rows_per_block)
        : m_width(width), m_height(height), m_rows(rows_per_block) {}

    [[nodiscard]] int width() const override { return m_width; }

    [[nodiscard]] std::size_t block_count() const override {
        return (static_cast<std::size_t>(m_height) + static_cast<std::size_t>(m_rows) - 1) /
               static_cast<std::size_t>(m_rows);
    }

    [[nodiscard]] std::size_t block_of_row(int row) const override {
        return static_cast<std::size_t>(row / m_rows);
    }

    [[nodiscard]] RowRange rows_of_block(std::size_t block) const override {
        const auto first = static_cast<std::int64_t>(block) * m_rows;
        return {static_cast<int>(first),
                static_cast<int>(std::min<std::int64_t>(first + m_rows, m_height) - 1)};
    }

  private:
    int m_width, m_height, m_rows;
};

}  // namespace osio::image
