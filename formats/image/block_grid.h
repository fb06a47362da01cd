// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <algorithm>
#include <cstddef>

namespace osio::image {

/// Squares of pixels that cover a window from its upper left corner on; the last of a row or column may be cut.
struct BlockGrid {
    Window window;
    int side = 1;  ///< pixels, 1 or more

    [[nodiscard]] int columns() const { return (window.width() + side - 1) / side; }

    [[nodiscard]] int rows() const { return (window.height() + side - 1) / side; }

    [[nodiscard]] std::size_t squares() const {
        return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
    }

    /// Where the middle of a square is, in the coordinates of the window; of two pixels the left or upper one.
    [[nodiscard]] int middle_x(int column) const {
        return middle(window.min_x + column * side, window.max_x);
    }

    [[nodiscard]] int middle_y(int row) const { return middle(window.min_y + row * side, window.max_y); }

  private:
    [[nodiscard]] int middle(int first, int end) const {
        return first + (std::min(first + side - 1, end) - first) / 2;
    }
};

}  // namespace osio::image
