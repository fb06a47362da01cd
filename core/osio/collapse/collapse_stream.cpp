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

/// 81 bands of floats are 166 kB then.
constexpr std::size_t kWitnessedPixels = 512;

/// What all workers of one collapse share. `counts` belongs to deliver(), one call at a time.
struct Collapse {
    std::span<const CollapseTarget> targets;
    WeightMatrix weights;  ///< the rows of all plans
    bool has_alpha = false;
    std::size_t width = 0;
    RowRange rows;
    std::vector<CollapseCounts> counts;
};

/// 1 for NaN, plus 2 for an infinity, plus 4 for what is below zero.
std::uint32_t oddness(float value) {
    constexpr std::uint32_t kInfinity = 0x7F800000;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7FFFFFFF;
    const std::uint32_t nan = magnitude > kInfinity;
    const std::uint32_t infinite = magnitude == kInfinity;
    const std::uint32_t negative = (bits >> 31) & (nan ^ 1) & (magnitude != 0);
    return nan | infinite << 1 | negative << 2;
}

/// In integers and short runs, which compilers turn into vectors.
CollapseCounts count(std::span<const float* const> planes, std::uint64_t pixels) {
    constexpr std::size_t kRun = 1024;
    CollapseCounts counts;
    counts.pixels = pixels;
    std::array<std::uint32_t, kRun> flags;
    for (std::size_t first = 0; first < pixels; first += kRun) {
        const std::size_t run = std::min<std::size_t>(kRun, pixels - first);
        flags.fill(0);
        for (const float* plane : planes)
            for (std::size_t i = 0; i < run; ++i)
                flags[i] |= oddness(plane[first + i]);
        std::uint32_t nan = 0, infinite = 0, negative = 0;
        for (std::size_t i = 0; i < run; ++i) {
            nan += flags[i] & 1;
            infinite += flags[i] >> 1 & 1;
            negative += flags[i] >> 2;
        }
        counts.nan += nan;
        counts.infinite += infinite;
        counts.negative += negative;
    }
    return counts;
}

/// A worker's share of one target.
struct Branch {
    explicit Branch(const CollapseTarget& target)
        : plan(target.plan), stage(target.plan.space, target.plan.white), sums(target.plan.weights.rows()),
          worker(target.sink.start_worker()),
          witness(target.witness ? target.witness->start_worker() : nullptr) {}

    const CollapsePlan& plan;
    PixelStage stage;
    std::size_t sums;  ///< rows of weights
    std::unique_ptr<RowWorker> worker;
    std::unique_ptr<WitnessWorker> witness;
    CollapseCounts counts;
};

/// Collapses blocks into planes of its own, reused from block to block.
class Collapser final : public BlockVisitor {
  public:
    explicit Collapser(Collapse& collapse)
        : m_shared(collapse), m_planes(collapse.weights.rows() + (collapse.has_alpha ? 1 : 0)) {
        for (const CollapseTarget& target : collapse.targets) {
            m_branches.emplace_back(target);
            m_witnessed = m_witnessed || target.witness != nullptr;
        }
    }

    void process(const PlanarBlock& block) override {
        const std::size_t pixels = static_cast<std::size_t>(block.row_count) * m_shared.width;
        m_pointers.clear();
        for (std::vector<float>& plane : m_planes) {
            plane.resize(pixels);
            m_pointers.push_back(plane.data());
        }
        block.for_each_run([this](std::size_t first, std::size_t count, std::span<const BandView> planes) {
            sum(first, count, planes);
        });
        m_first_row = std::max(m_shared.rows.first, block.first_row);
        m_row_count = std::min(m_shared.rows.last, block.first_row + block.row_count - 1) - m_first_row + 1;
        m_prepared = {};
        std::size_t first = 0;
        for (Branch& branch : m_branches) {
            if (m_prepared)
                m_prepared = finish(branch, first, block, pixels);
            first += branch.sums;
        }
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        OSIO_CHECK_OK(m_prepared);
        for (std::size_t i = 0; i < m_branches.size(); ++i) {
            m_shared.counts[i] += m_branches[i].counts;
            if (m_branches[i].witness)
                m_branches[i].witness->deliver();
            OSIO_CHECK_OK(m_branches[i].worker->deliver());
        }
        return {};
    }

  private:
    /// The sums of some pixels, and their alpha. Where somebody looks on, in pieces that stay in the cache
    /// until they have been looked at.
    void sum(std::size_t first, std::size_t count, std::span<const BandView> planes) {
        const auto bands = planes.first(m_shared.weights.bands());
        m_summed.clear();
        for (const BandView& band : bands)
            m_summed.push_back(is_zero(band, count) ? BandView{} : band);
        const std::size_t piece = m_witnessed ? kWitnessedPixels : count;
        for (std::size_t done = 0; done < count; done += piece)
            sum_piece(bands, done, first + done, std::min(piece, count - done));
        if (m_shared.has_alpha)
            for (std::size_t pixel = 0; pixel < count; ++pixel)
                m_planes.back()[first + pixel] = static_cast<float>(sample_at(planes.back(), pixel));
    }

    void sum_piece(std::span<const BandView> bands, std::size_t from, std::size_t to, std::size_t count) {
        m_sums.clear();
        for (std::size_t row = 0; row < m_shared.weights.rows(); ++row)
            m_sums.push_back(m_planes[row].data() + to);
        advance(m_summed, from);
        collapse_run(m_piece, m_shared.weights, count, m_sums);
        if (!m_witnessed)
            return;
        advance(bands, from);
        const float* const* sums = m_sums.data();
        for (const Branch& branch : m_branches) {
            if (branch.witness)
                branch.witness->look(m_piece, count, {sums, branch.sums});
            sums += branch.sums;
        }
    }

    void advance(std::span<const BandView> bands, std::size_t pixels) {
        m_piece.clear();
        for (const BandView& band : bands)
            m_piece.push_back(band.advanced(pixels));
    }

    /// Turns the sums from plane `first` on into what the target's space means, and prepares its rows.
    Result<void> finish(Branch& branch, std::size_t first, const PlanarBlock& block, std::size_t pixels) {
        const std::span<float* const> sums(m_pointers.data() + first, branch.sums);
        const float* const alpha = m_shared.has_alpha ? m_planes.back().data() : nullptr;
        const std::size_t skip = static_cast<std::size_t>(m_first_row - block.first_row) * m_shared.width;
        const std::size_t delivered = static_cast<std::size_t>(m_row_count) * m_shared.width;
        PolarisationCounts polarisation;
        std::size_t results = sums.size();
        if (branch.stage.needed())
            branch.stage.apply(sums.first<3>(), alpha, pixels);
        if (is_polarisation(branch.plan.space.kind)) {
            m_components.clear();
            for (float* const plane : sums)
                m_components.push_back(plane + skip);
            polarisation = polarise(branch.plan.space.kind, m_components,
                                    alpha != nullptr ? alpha + skip : nullptr, delivered);
            results = 1;
        }
        m_rows.clear();
        for (const float* plane : sums.first(results))
            m_rows.push_back(plane + skip);
        branch.counts = count(m_rows, delivered);
        branch.counts.polarisation = polarisation;
        if (!branch.stage.negative_is_outside() || branch.plan.has_sign)
            branch.counts.negative = 0;
        if (m_shared.has_alpha)
            m_rows.push_back(m_planes.back().data() + skip);
        return branch.worker->prepare(m_first_row, m_row_count, m_rows);
    }

    Collapse& m_shared;
    std::vector<Branch> m_branches;
    Result<void> m_prepared;
    std::vector<std::vector<float>> m_planes;
    std::vector<float*> m_pointers;
    std::vector<BandView> m_summed;    ///< of the run in work: no band that is zero all along it
    std::vector<BandView> m_piece;     ///< of the run in work
    std::vector<float*> m_sums;        ///< of the run in work
    std::vector<float*> m_components;  ///< of the rows to deliver
    bool m_witnessed = false;
    std::vector<const float*> m_rows;
    int m_first_row = 0;
    int m_row_count = 0;
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
    polarisation.undefined += other.polarisation.undefined;
    polarisation.beyond += other.polarisation.beyond;
    return *this;
}

Result<std::vector<CollapseCounts>> collapse_stream(const BlockSource& source,
                                                    std::span<const CollapseTarget> targets, bool has_alpha,
                                                    RowRange rows, Runner& runner, const Progress& progress) {
    Collapse collapse{targets, {}, has_alpha, static_cast<std::size_t>(source.width()), rows, {}};
    for (const CollapseTarget& target : targets)
        collapse.weights.append(target.plan.weights);
    collapse.counts.resize(targets.size());
    const auto start = [&] { return std::make_unique<Collapser>(collapse); };
    OSIO_CHECK_OK(visit_blocks(source, rows, runner, start, progress));
    return std::move(collapse.counts);
}

Result<CollapseCounts> collapse_stream(const BlockSource& source, const CollapsePlan& plan, bool has_alpha,
                                       RowRange rows, RowSink& sink, Runner& runner,
                                       const Progress& progress) {
    const CollapseTarget target{plan, sink};
    OSIO_TRY(const auto counts, collapse_stream(source, {&target, 1}, has_alpha, rows, runner, progress));
    return counts.front();
}

}  // namespace osio
