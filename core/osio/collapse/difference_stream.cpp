// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/difference_stream.h>
#include <osio/collapse/kernel.h>
#include <osio/colour/difference.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace osio {

namespace {

/// A block as XYZ, and its pixels as Lab.
class XyzBlock {
  public:
    XyzBlock(const XyzRecipe& recipe, std::size_t width) : m_recipe(recipe), m_width(width) {}

    void make(const PlanarBlock& block) {
        m_first_row = block.first_row;
        const std::size_t pixels = static_cast<std::size_t>(block.row_count) * m_width;
        for (std::vector<float>& plane : m_xyz)
            plane.resize(pixels);
        block.for_each_run([this](std::size_t first, std::size_t count, std::span<const BandView> planes) {
            sum(first, count, planes);
        });
    }

    [[nodiscard]] Lab lab_at(int row, std::size_t column) const {
        const std::size_t i = static_cast<std::size_t>(row - m_first_row) * m_width + column;
        return lab_of({static_cast<double>(m_xyz[0][i]), static_cast<double>(m_xyz[1][i]),
                       static_cast<double>(m_xyz[2][i])},
                      m_recipe.white);
    }

  private:
    void sum(std::size_t first, std::size_t count, std::span<const BandView> planes) {
        const std::array<float*, 3> out{m_xyz[0].data() + first, m_xyz[1].data() + first,
                                        m_xyz[2].data() + first};
        if (m_recipe.transfer == Transfer::Linear)
            return collapse_run(planes, m_recipe.weights, count, out);
        m_linear.resize(planes.size());
        std::vector<BandView> linear;
        for (std::size_t p = 0; p < planes.size(); ++p) {
            m_linear[p].resize(count);
            for (std::size_t i = 0; i < count; ++i)
                m_linear[p][i] = static_cast<float>(srgb_decode(sample_at(planes[p], i)));
            linear.push_back({reinterpret_cast<const std::byte*>(m_linear[p].data()), SampleType::Float,
                              static_cast<std::ptrdiff_t>(sizeof(float))});
        }
        collapse_run(linear, m_recipe.weights, count, out);
    }

    const XyzRecipe& m_recipe;
    std::size_t m_width;
    int m_first_row = 0;
    std::array<std::vector<float>, 3> m_xyz;
    std::vector<std::vector<float>> m_linear;
};

/// What all workers of one comparison share. `counts` and `map` belong to deliver().
struct Comparison {
    const DifferenceSide& a;
    const DifferenceSide& b;
    RowRange rows;
    const DifferenceLimits& limits;
    RowSink* map;
    DifferenceCounts counts;
};

/// Blocks of A as they come; of B, those that hold the same rows.
class Comparer final : public BlockVisitor {
  public:
    explicit Comparer(Comparison& comparison)
        : m_shared(comparison), m_width(static_cast<std::size_t>(comparison.a.source.width())),
          m_a(comparison.a.recipe, m_width), m_b(comparison.b.recipe, m_width) {}

    void process(const PlanarBlock& block) override {
        m_first_row = std::max(m_shared.rows.first, block.first_row);
        m_row_count = std::min(m_shared.rows.last, block.first_row + block.row_count - 1) - m_first_row + 1;
        m_delta.clear();
        m_a.make(block);
        for (int row = m_first_row; row < m_first_row + m_row_count; ++row) {
            m_status = fetch_b(row);
            if (!m_status)
                return;
            for (std::size_t column = 0; column < m_width; ++column)
                m_delta.push_back(
                    static_cast<float>(delta_e_2000(m_a.lab_at(row, column), m_b.lab_at(row, column))));
        }
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        OSIO_CHECK_OK(m_status);
        DifferenceCounts& counts = m_shared.counts;
        for (std::size_t i = 0; i < m_delta.size(); ++i) {
            const double delta = static_cast<double>(m_delta[i]);
            const bool larger = counts.delta_e.count() == 0 || delta > counts.delta_e.maximum();
            counts.delta_e.add(delta);
            if (larger && std::isfinite(delta))
                counts.largest_at = {static_cast<int>(i % m_width),
                                     m_first_row + static_cast<int>(i / m_width)};
            const bool none = !std::isfinite(delta);
            counts.beyond_fail += none || delta > m_shared.limits.fail;
            counts.beyond_warn += none || delta > m_shared.limits.warn;
        }
        if (m_shared.map == nullptr)
            return {};
        const float* const plane = m_delta.data();
        return m_shared.map->write_rows(m_first_row, m_row_count, {&plane, 1});
    }

  private:
    Result<void> fetch_b(int row) {
        const BlockSource& source = m_shared.b.source;
        const std::size_t block = source.block_of_row(row);
        if (m_b_block == block)
            return {};
        if (!m_b_reader) {
            OSIO_TRY(m_b_reader, source.start_reader());
        }
        OSIO_TRY(const PlanarBlock planes, m_b_reader->read(block));
        m_b.make(planes);
        m_b_block = block;
        return {};
    }

    Comparison& m_shared;
    std::size_t m_width;
    XyzBlock m_a, m_b;
    std::unique_ptr<BlockReader> m_b_reader;
    std::optional<std::size_t> m_b_block;
    std::vector<float> m_delta;
    int m_first_row = 0;
    int m_row_count = 0;
    Result<void> m_status;
};

}  // namespace

Result<DifferenceCounts> difference_stream(const DifferenceSide& a, const DifferenceSide& b, RowRange rows,
                                           const DifferenceLimits& limits, RowSink* map, Runner& runner,
                                           const Progress& progress) {
    Comparison comparison{a, b, rows, limits, map, {}};
    const auto start = [&] { return std::make_unique<Comparer>(comparison); };
    OSIO_CHECK_OK(visit_blocks(a.source, rows, runner, start, progress));
    return std::move(comparison.counts);
}

}  // namespace osio
