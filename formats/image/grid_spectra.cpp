// SPDX-License-Identifier: Apache-2.0
#include <formats/image/grid_spectra.h>

#include <osio/collapse/kernel.h>

namespace osio::image {

namespace {

/// Copies what it wants of a block; squares of different rows are different places, so no turn has to be awaited.
class Picker final : public BlockVisitor {
  public:
    Picker(const BlockGrid& grid, std::vector<float>& out) : m_grid(grid), m_out(out) {}

    void process(const PlanarBlock& block) override {
        const Window& window = m_grid.window;
        const int first = (block.first_row - window.min_y) / m_grid.side;
        const int last = (block.first_row + block.row_count - 1 - window.min_y) / m_grid.side;
        for (int row = first; row <= last; ++row) {
            const int y = m_grid.middle_y(row);
            if (y < block.first_row || y >= block.first_row + block.row_count)
                continue;
            const PlanarBlock line = block.among({y, y});
            for (std::size_t band = 0; band < line.planes.size(); ++band)
                pick(line.planes[band], band * m_grid.squares() + static_cast<std::size_t>(row) * columns());
        }
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override { return {}; }

  private:
    [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(m_grid.columns()); }

    void pick(const BandView& band, std::size_t to) {
        for (std::size_t column = 0; column < columns(); ++column) {
            const int x = m_grid.middle_x(static_cast<int>(column)) - m_grid.window.min_x;
            m_out[to + column] = static_cast<float>(sample_at(band, static_cast<std::size_t>(x)));
        }
    }

    const BlockGrid& m_grid;
    std::vector<float>& m_out;
};

}  // namespace

Result<std::vector<float>> grid_spectra(const SpectralImage& image, const Selection& selection,
                                        const BlockGrid& grid, Runner& runner, const Progress& progress) {
    const SpectralSet& set = image.parts()[selection.part].layout.sets[selection.set];
    PlaneChannels planes;
    for (const Band& band : set.bands)
        planes.emplace_back(band.channel);
    OSIO_TRY(const auto source, image.make_block_source(selection.part, std::move(planes), Grain::Block));
    std::vector<float> out(set.bands.size() * grid.squares());
    const auto start = [&] { return std::make_unique<Picker>(grid, out); };
    OSIO_CHECK_OK(visit_blocks(*source, {grid.window.min_y, grid.window.max_y}, runner, start, progress));
    return out;
}

}  // namespace osio::image
