// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/kernel.h>
#include <osio/collapse/pixel_stage.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace osio {

namespace {

/// Keeps rows for their turn.
class DirectWorker final : public RowWorker {
  public:
    explicit DirectWorker(RowSink& sink) : m_sink(sink) {}

    [[nodiscard]] Result<void> prepare(int first_row, int row_count,
                                       std::span<const float* const> planes) override {
        m_first_row = first_row;
        m_row_count = row_count;
        m_planes.assign(planes.begin(), planes.end());
        return {};
    }

    [[nodiscard]] Result<void> deliver() override {
        return m_sink.write_rows(m_first_row, m_row_count, m_planes);
    }

  private:
    RowSink& m_sink;
    std::vector<const float*> m_planes;
    int m_first_row = 0;
    int m_row_count = 0;
};

/// What all workers of one collapse share. `counts` belongs to deliver(), one call at a time.
struct Collapse {
    const CollapsePlan& plan;
    bool has_alpha = false;
    std::size_t width = 0;
    RowRange rows;
    RowSink& sink;
    CollapseCounts counts;
};

/// Collapses blocks into planes of its own, reused from block to block.
class Collapser final : public BlockVisitor {
  public:
    explicit Collapser(Collapse& collapse)
        : m_shared(collapse), m_plan(collapse.plan), m_stage(collapse.plan.space, collapse.plan.white),
          m_worker(collapse.sink.start_worker()),
          m_planes(collapse.plan.weights.rows() + (collapse.has_alpha ? 1 : 0)) {}

    void process(const PlanarBlock& block) override {
        const std::size_t pixels = static_cast<std::size_t>(block.row_count) * m_shared.width;
        m_pointers.clear();
        for (std::vector<float>& plane : m_planes) {
            plane.resize(pixels);
            m_pointers.push_back(plane.data());
        }
        const std::size_t rows = m_plan.weights.rows();
        const std::span<const BandView> bands(block.planes.data(), m_plan.bands.size());
        collapse_run(bands, m_plan.weights, pixels, std::span(m_pointers).first(rows));
        if (m_shared.has_alpha)
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                m_planes.back()[pixel] = static_cast<float>(sample_at(block.planes.back(), pixel));
        if (m_stage.needed())
            m_stage.apply(std::span(m_pointers).first<3>(),
                          m_shared.has_alpha ? m_planes.back().data() : nullptr, pixels);
        m_first_row = std::max(m_shared.rows.first, block.first_row);
        m_row_count = std::min(m_shared.rows.last, block.first_row + block.row_count - 1) - m_first_row + 1;
        const std::vector<const float*> planes = rows_of(block);
        m_counts = count(planes);
        m_prepared = m_worker->prepare(m_first_row, m_row_count, planes);
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        OSIO_CHECK_OK(m_prepared);
        m_shared.counts += m_counts;
        return m_worker->deliver();
    }

  private:
    /// The wanted rows of the last block, one pointer a channel.
    [[nodiscard]] std::vector<const float*> rows_of(const PlanarBlock& block) const {
        const std::size_t skip = static_cast<std::size_t>(m_first_row - block.first_row) * m_shared.width;
        std::vector<const float*> out;
        for (const float* plane : m_pointers)
            out.push_back(plane + skip);
        return out;
    }

    /// In integers and short runs, which compilers turn into vectors.
    [[nodiscard]] CollapseCounts count(std::span<const float* const> planes) const {
        constexpr std::size_t kRun = 1024;
        CollapseCounts counts;
        counts.pixels = static_cast<std::uint64_t>(m_row_count) * m_shared.width;
        std::array<std::uint32_t, kRun> flags;
        for (std::size_t first = 0; first < counts.pixels; first += kRun) {
            const std::size_t run = std::min(kRun, counts.pixels - first);
            flags.fill(0);
            for (std::size_t row = 0; row < m_plan.weights.rows(); ++row)
                for (std::size_t i = 0; i < run; ++i)
                    flags[i] |= oddness(planes[row][first + i]);
            std::uint32_t nan = 0, infinite = 0, negative = 0;
            for (std::size_t i = 0; i < run; ++i) {
                nan += flags[i] & 1;
                infinite += flags[i] >> 1 & 1;
                negative += flags[i] >> 2;
            }
            counts.nan += nan;
            counts.infinite += infinite;
            counts.negative += m_stage.negative_is_outside() ? negative : 0;
        }
        return counts;
    }

    /// 1 for NaN, plus 2 for an infinity, plus 4 for what is below zero.
    static std::uint32_t oddness(float value) {
        constexpr std::uint32_t kInfinity = 0x7F800000;
        const auto bits = std::bit_cast<std::uint32_t>(value);
        const std::uint32_t magnitude = bits & 0x7FFFFFFF;
        const std::uint32_t nan = magnitude > kInfinity;
        const std::uint32_t infinite = magnitude == kInfinity;
        const std::uint32_t negative = (bits >> 31) & (nan ^ 1) & (magnitude != 0);
        return nan | infinite << 1 | negative << 2;
    }

    Collapse& m_shared;
    const CollapsePlan& m_plan;
    PixelStage m_stage;
    std::unique_ptr<RowWorker> m_worker;
    Result<void> m_prepared;
    std::vector<std::vector<float>> m_planes;
    std::vector<float*> m_pointers;
    int m_first_row = 0;
    int m_row_count = 0;
    CollapseCounts m_counts;
};

}  // namespace

std::unique_ptr<RowWorker> RowSink::start_worker() {
    return std::make_unique<DirectWorker>(*this);
}

CollapseCounts& CollapseCounts::operator+=(const CollapseCounts& other) {
    pixels += other.pixels;
    nan += other.nan;
    infinite += other.infinite;
    negative += other.negative;
    return *this;
}

Result<CollapseCounts> collapse_stream(const BlockSource& source, const CollapsePlan& plan, bool has_alpha,
                                       RowRange rows, RowSink& sink, Runner& runner,
                                       const Progress& progress) {
    Collapse collapse{plan, has_alpha, static_cast<std::size_t>(source.width()), rows, sink, {}};
    const auto start = [&] { return std::make_unique<Collapser>(collapse); };
    OSIO_CHECK_OK(visit_blocks(source, rows, runner, start, progress));
    return collapse.counts;
}

}  // namespace osio
