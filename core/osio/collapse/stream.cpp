// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/stream.h>

#include <osio/collapse/kernel.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <new>
#include <optional>

namespace osio {

namespace {

/// Blocks are taken in order, so whoever holds the smallest number can always go on: waiting for
/// one's turn never blocks the work that it waits for, even where a runner runs its workers one
/// after another.
class Turnstile {
  public:
    Turnstile(std::size_t first, std::size_t end) : m_next_taken(first), m_turn(first), m_end(end) {}

    std::optional<std::size_t> take() {
        const std::size_t block = m_next_taken.fetch_add(1);
        return block < m_end && !m_failed ? std::optional(block) : std::nullopt;
    }

    /// Runs `body` when every earlier block has been through; false once anything has failed.
    template <class Body>
    bool in_turn(std::size_t block, Body body) {
        std::unique_lock lock(m_mutex);
        m_passed.wait(lock, [&] { return m_turn == block || m_failed; });
        if (m_failed)
            return false;
        if (Result<void> result = body(); !result) {
            fail_locked(std::move(result).error());
            return false;
        }
        ++m_turn;
        m_passed.notify_all();
        return true;
    }

    void fail_with(Error error) {
        const std::lock_guard lock(m_mutex);
        fail_locked(std::move(error));
    }

    std::optional<Error> error() const { return m_error; }

  private:
    void fail_locked(Error error) {
        if (!m_error)
            m_error = std::move(error);
        m_failed = true;
        m_passed.notify_all();
    }

    std::atomic<std::size_t> m_next_taken;
    std::atomic<bool> m_failed = false;
    std::mutex m_mutex;
    std::condition_variable m_passed;
    std::size_t m_turn;
    const std::size_t m_end;
    std::optional<Error> m_error;
};

/// What one worker needs to collapse a block; reused from block to block.
class BlockCollapser {
  public:
    BlockCollapser(const CollapsePlan& plan, bool has_alpha, int width)
        : m_plan(plan), m_has_alpha(has_alpha), m_width(static_cast<std::size_t>(width)),
          m_planes(plan.weights.rows() + (has_alpha ? 1 : 0)) {}

    void collapse(const PlanarBlock& block) {
        const std::size_t pixels = static_cast<std::size_t>(block.row_count) * m_width;
        m_pointers.clear();
        for (std::vector<float>& plane : m_planes) {
            plane.resize(pixels);
            m_pointers.push_back(plane.data());
        }
        const std::size_t rows = m_plan.weights.rows();
        const std::span<const BandView> bands(block.planes.data(), m_plan.bands.size());
        collapse_run(bands, m_plan.weights, pixels, std::span(m_pointers).first(rows));
        if (m_has_alpha)
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                m_planes.back()[pixel] = static_cast<float>(sample_at(block.planes.back(), pixel));
        if (m_plan.space.transfer == Transfer::Srgb)
            encode(pixels);
    }

    /// The rows of the last block from `first` on, one pointer a channel.
    [[nodiscard]] std::vector<const float*> planes_from(int first_row_in_block) const {
        const std::size_t skip = static_cast<std::size_t>(first_row_in_block) * m_width;
        std::vector<const float*> out;
        for (const float* plane : m_pointers)
            out.push_back(plane + skip);
        return out;
    }

    [[nodiscard]] CollapseCounts count(std::span<const float* const> planes, int row_count) const {
        CollapseCounts counts;
        counts.pixels = static_cast<std::uint64_t>(row_count) * m_width;
        for (std::size_t pixel = 0; pixel < counts.pixels; ++pixel) {
            bool nan = false, infinite = false, negative = false;
            for (std::size_t row = 0; row < m_plan.weights.rows(); ++row) {
                const float value = planes[row][pixel];
                nan |= std::isnan(value);
                infinite |= std::isinf(value);
                negative |= value < 0;
            }
            counts.nan += nan;
            counts.infinite += infinite;
            counts.negative += negative;
        }
        return counts;
    }

  private:
    void encode(std::size_t pixels) {
        for (std::size_t row = 0; row < m_plan.weights.rows(); ++row) {
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                float& value = m_planes[row][pixel];
                const double alpha = m_has_alpha ? static_cast<double>(m_planes.back()[pixel]) : 1;
                const bool associated = alpha > 0 && alpha != 1;
                const double linear = static_cast<double>(value) / (associated ? alpha : 1);
                value = static_cast<float>(srgb_encode(linear) * (associated ? alpha : 1));
            }
        }
    }

    const CollapsePlan& m_plan;
    bool m_has_alpha;
    std::size_t m_width;
    std::vector<std::vector<float>> m_planes;
    std::vector<float*> m_pointers;
};

}  // namespace

CollapseCounts& CollapseCounts::operator+=(const CollapseCounts& other) {
    pixels += other.pixels;
    nan += other.nan;
    infinite += other.infinite;
    negative += other.negative;
    return *this;
}

Result<CollapseCounts> collapse_stream(const BlockSource& source, const CollapsePlan& plan,
                                       bool has_alpha, RowRange rows, RowSink& sink, Runner& runner,
                                       const Progress& progress) {
    const std::size_t first = source.block_of_row(rows.first);
    const std::size_t end = source.block_of_row(rows.last) + 1;
    Turnstile turnstile(first, end);
    CollapseCounts counts;

    const auto pass_on = [&](const BlockCollapser& collapser, const PlanarBlock& block,
                             std::size_t index) -> bool {
        const int top = std::max(rows.first, block.first_row);
        const int row_count = std::min(rows.last, block.first_row + block.row_count - 1) - top + 1;
        const auto planes = collapser.planes_from(top - block.first_row);
        const CollapseCounts met = collapser.count(planes, row_count);
        return turnstile.in_turn(index, [&]() -> Result<void> {
            OSIO_CHECK_OK(sink.write_rows(top, row_count, planes));
            counts += met;
            const auto done = static_cast<double>(index + 1 - first);
            if (progress && !progress(done / static_cast<double>(end - first)))
                return fail(ErrorCode::Cancelled, "interrupted");
            return {};
        });
    };
    const auto work = [&]() -> Result<void> {
        OSIO_TRY(const auto reader, source.start_reader());
        BlockCollapser collapser(plan, has_alpha, source.width());
        while (const auto index = turnstile.take()) {
            OSIO_TRY(const PlanarBlock block, reader->read(*index));
            collapser.collapse(block);
            if (!pass_on(collapser, block, *index))
                break;
        }
        return {};
    };
    runner.run([&](unsigned) {
        try {
            if (auto result = work(); !result)
                turnstile.fail_with(std::move(result).error());
        } catch (const std::bad_alloc&) {
            turnstile.fail_with({ErrorCode::Io, "out of memory", {}});
        }
    });
    if (auto error = turnstile.error())
        return tl::unexpected(std::move(*error));
    return counts;
}

}  // namespace osio
