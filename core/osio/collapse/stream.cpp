// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/stream.h>

#include <algorithm>
#include <atomic>
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

    [[nodiscard]] std::optional<Error> error() const { return m_error; }

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

}  // namespace

void PlanarBlock::for_each_run(const Run& run) const {
    const auto row_pixels = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(row_count);
    if (row_pitch_bytes == 0)
        return run(0, rows * row_pixels, planes);
    std::vector<BandView> views = planes;
    for (std::size_t row = 0; row < rows; ++row) {
        run(row * row_pixels, row_pixels, views);
        for (BandView& view : views)
            if (view.data != nullptr)
                view.data += row_pitch_bytes;
    }
}

PlanarBlock PlanarBlock::among(RowRange rows) const {
    const int first = std::max(rows.first, first_row);
    const int last = std::min(rows.last, first_row + row_count - 1);
    PlanarBlock out{first, last - first + 1, width, planes, row_pitch_bytes};
    for (BandView& view : out.planes) {
        if (view.data == nullptr)
            continue;
        const std::ptrdiff_t row_bytes =
            row_pitch_bytes != 0 ? row_pitch_bytes : view.pixel_stride_bytes * width;
        view.data += (first - first_row) * row_bytes;
    }
    return out;
}

Result<void> visit_blocks(const BlockSource& source, RowRange rows, Runner& runner, const StartVisitor& start,
                          const Progress& progress) {
    const std::size_t first = source.block_of_row(rows.first);
    const std::size_t end = source.block_of_row(rows.last) + 1;
    Turnstile turnstile(first, end);

    const auto report = [&](std::size_t index) -> Result<void> {
        const auto done = static_cast<double>(index + 1 - first);
        if (progress && !progress(done / static_cast<double>(end - first)))
            return fail(ErrorCode::Cancelled, "interrupted");
        return {};
    };
    const auto work = [&]() -> Result<void> {
        OSIO_TRY(const auto reader, source.start_reader());
        const auto visitor = start();
        while (const auto index = turnstile.take()) {
            const Result<PlanarBlock> block = reader->read(*index);
            if (block)
                visitor->process(*block);
            // An unreadable block fails in its turn too: whichever thread is first, the error named is
            // that of the first bad block.
            const auto deliver = [&]() -> Result<void> {
                if (!block)
                    return tl::unexpected(block.error());
                OSIO_CHECK_OK(visitor->deliver(*block));
                return report(*index);
            };
            if (!turnstile.in_turn(*index, deliver))
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
    return {};
}

}  // namespace osio
