// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/collapse_stream.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>

namespace osio::trade {

/// Time that workers spend in one kind of work, all together.
class Stopwatch {
  public:
    template <class Work>
    auto time(Work work) {
        const auto start = std::chrono::steady_clock::now();
        auto result = work();
        m_ns += (std::chrono::steady_clock::now() - start).count();
        return result;
    }

    [[nodiscard]] double seconds() const { return static_cast<double>(m_ns) * 1e-9; }

  private:
    std::atomic<std::int64_t> m_ns{0};
};

/// A source whose readers are timed.
class TimedSource final : public WrappedSource {
  public:
    TimedSource(std::unique_ptr<BlockSource> source, Stopwatch& watch)
        : WrappedSource(std::move(source)), m_watch(watch) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, inner().start_reader());
        return std::make_unique<Reader>(std::move(reader), m_watch);
    }

  private:
    class Reader final : public BlockReader {
      public:
        Reader(std::unique_ptr<BlockReader> reader, Stopwatch& watch)
            : m_reader(std::move(reader)), m_watch(watch) {}

        [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
            return m_watch.time([&] { return m_reader->read(block); });
        }

      private:
        std::unique_ptr<BlockReader> m_reader;
        Stopwatch& m_watch;
    };

    Stopwatch& m_watch;
};

/// A sink whose work is timed, packing and writing together.
class TimedSink final : public RowSink {
  public:
    TimedSink(RowSink& sink, Stopwatch& watch) : m_sink(sink), m_watch(watch) {}

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override {
        return m_watch.time([&] { return m_sink.write_rows(first_row, row_count, planes); });
    }

    [[nodiscard]] std::unique_ptr<RowWorker> start_worker() override {
        return std::make_unique<Worker>(m_sink.start_worker(), m_watch);
    }

  private:
    class Worker final : public RowWorker {
      public:
        Worker(std::unique_ptr<RowWorker> worker, Stopwatch& watch)
            : m_worker(std::move(worker)), m_watch(watch) {}

        [[nodiscard]] Result<void> prepare(int first_row, int row_count,
                                           std::span<const float* const> planes) override {
            return m_watch.time([&] { return m_worker->prepare(first_row, row_count, planes); });
        }

        [[nodiscard]] Result<void> deliver() override {
            return m_watch.time([&] { return m_worker->deliver(); });
        }

      private:
        std::unique_ptr<RowWorker> m_worker;
        Stopwatch& m_watch;
    };

    RowSink& m_sink;
    Stopwatch& m_watch;
};

}  // namespace osio::trade
