// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/compare.h>
#include <formats/trade/pictures.h>

#include <osio/colour/adaptation.h>
#include <osio/colour/rgb_space.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osio::trade {

namespace {

/// What has been seen of a square so far.
struct Square {
    std::array<float, 3> sum{};
    std::uint32_t count = 0;
    float largest = std::numeric_limits<float>::quiet_NaN();

    void add(const std::array<float, 3>& rgb, float delta) {
        if (!std::isfinite(delta))
            return;
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += rgb[c];
        ++count;
        largest = std::fmax(largest, delta);
    }
};

class Collector {
  public:
    Collector(const image::BlockGrid& grid, std::size_t choices)
        : m_grid(grid), m_squares(choices, std::vector<Square>(grid.squares())) {}

    void add(const ComparedRows& rows) {
        const auto width = static_cast<std::size_t>(m_grid.window.width());
        const auto side = static_cast<std::size_t>(m_grid.side);
        for (int row = 0; row < rows.row_count; ++row) {
            const int line = (rows.first_row + row - m_grid.window.min_y) / m_grid.side;
            Square* const squares =
                m_squares[rows.choice].data() +
                static_cast<std::size_t>(line) * static_cast<std::size_t>(m_grid.columns());
            const std::size_t first = static_cast<std::size_t>(row) * width;
            for (std::size_t x = 0; x < width; ++x)
                squares[x / side].add(
                    {rows.planes[0][first + x], rows.planes[1][first + x], rows.planes[2][first + x]},
                    rows.delta_e[first + x]);
        }
    }

    [[nodiscard]] Picture picture(std::size_t choice, const Matrix3& rec709_from_output) const {
        Picture out;
        for (const Square& square : m_squares[choice]) {
            Vector3 mean{};
            for (std::size_t c = 0; c < 3; ++c)
                mean[c] = static_cast<double>(square.sum[c]) / std::max(1U, square.count);
            bool clipped = false;
            for (const double linear : rec709_from_output* mean) {
                const double code = 255 * srgb_encode(linear);
                clipped = clipped || !(code > -0.5 && code < 255.5);
                out.srgb.push_back(
                    static_cast<std::uint8_t>(code > 0 ? std::lround(std::min(code, 255.0)) : 0));
            }
            out.clipped += clipped;
            out.delta_e.push_back(square.largest);
        }
        return out;
    }

  private:
    const image::BlockGrid& m_grid;
    std::vector<std::vector<Square>> m_squares;  ///< by choice
};

Matrix3 rec709_from_output(const Choices& choices) {
    const Matrix3 xyz_from_output = Matrix3::diagonal(choices.white) * choices.share_from_output;
    auto adapted = adaptation_matrix(Adaptation::Bradford, choices.white, kD65.xyz());
    if (!adapted)
        adapted = adaptation_matrix(Adaptation::XyzScaling, choices.white, kD65.xyz());
    const OutputSpace rec709 = *find_output_space("lin_rec709");
    return inverse(xyz_from_rgb(rec709)) * adapted.value_or(Matrix3::identity()) * xyz_from_output;
}

}  // namespace

Result<std::vector<Picture>> pictures_of(const image::CollapseJob& job, const Choices& choices,
                                         const image::BlockGrid& grid, Runner& runner,
                                         const Progress& progress) {
    Collector collector(grid, choices.list.size());
    OSIO_CHECK_OK(compare(job, choices, runner, progress,
                          [&collector](const ComparedRows& rows) { collector.add(rows); }));
    const Matrix3 matrix = rec709_from_output(choices);
    std::vector<Picture> out;
    for (std::size_t choice = 0; choice < choices.list.size(); ++choice)
        out.push_back(collector.picture(choice, matrix));
    return out;
}

}  // namespace osio::trade
