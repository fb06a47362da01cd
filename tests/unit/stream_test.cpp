// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/kernel.h>

#include <support/sets.h>

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <thread>

namespace osio::test {
namespace {

/// Runs a body on real threads, or one after another.
class TestRunner final : public Runner {
  public:
    TestRunner(unsigned count, bool parallel) : m_count(count), m_parallel(parallel) {}

    unsigned worker_count() const override { return m_count; }

    void run(const std::function<void(unsigned)>& body) override {
        if (!m_parallel) {
            for (unsigned worker = 0; worker < m_count; ++worker)
                body(worker);
            return;
        }
        std::vector<std::jthread> threads;
        for (unsigned worker = 0; worker < m_count; ++worker)
            threads.emplace_back([&body, worker] { body(worker); });
    }

  private:
    unsigned m_count;
    bool m_parallel;
};

/// An image of floats in memory, in blocks; can fail from a block on, at that block later than at others.
class MemorySource final : public BlockSource {
  public:
    MemorySource(int width, int height, int rows_per_block, std::size_t planes)
        : m_width(width), m_height(height), m_rows(rows_per_block), m_planes(planes) {
        for (std::size_t p = 0; p < planes; ++p) {
            m_data.emplace_back();
            for (int i = 0; i < width * height; ++i)
                m_data[p].push_back(static_cast<float>((i * 7 + static_cast<int>(p) * 13) % 101) / 50 - 0.3F);
        }
    }

    int width() const override { return m_width; }

    std::size_t block_count() const override {
        return static_cast<std::size_t>((m_height + m_rows - 1) / m_rows);
    }

    std::size_t block_of_row(int row) const override {
        return static_cast<std::size_t>((row - kTop) / m_rows);
    }

    RowRange rows_of_block(std::size_t block) const override {
        const int first = kTop + static_cast<int>(block) * m_rows;
        return {first, std::min(first + m_rows, kTop + m_height) - 1};
    }

    Result<std::unique_ptr<BlockReader>> start_reader() const override;

    float at(std::size_t plane, int x, int row) const {
        return m_data[plane][static_cast<std::size_t>((row - kTop) * m_width + x)];
    }

    static constexpr int kTop = -5;
    std::size_t bad_block = std::numeric_limits<std::size_t>::max();
    std::vector<std::vector<float>> m_data;
    mutable std::atomic<int> reads = 0;

  private:
    friend class MemoryReader;
    int m_width, m_height, m_rows;
    std::size_t m_planes;
};

class MemoryReader final : public BlockReader {
  public:
    explicit MemoryReader(const MemorySource& source) : m_source(source) {}

    Result<PlanarBlock> read(std::size_t block) override {
        ++m_source.reads;
        if (block == m_source.bad_block)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        if (block >= m_source.bad_block)
            return fail(ErrorCode::Damaged, "bad block " + std::to_string(block));
        const RowRange rows = m_source.rows_of_block(block);
        PlanarBlock out{rows.first, rows.last - rows.first + 1, m_source.m_width, {}};
        for (const auto& plane : m_source.m_data)
            out.planes.push_back({reinterpret_cast<const std::byte*>(
                                      plane.data() + (rows.first - MemorySource::kTop) * m_source.m_width),
                                  SampleType::Float, 4});
        return out;
    }

  private:
    const MemorySource& m_source;
};

Result<std::unique_ptr<BlockReader>> MemorySource::start_reader() const {
    return std::make_unique<MemoryReader>(*this);
}

/// Keeps rows and checks that they come in order; can fail at a row.
class MemorySink final : public RowSink {
  public:
    MemorySink(int width, int first_row) : m_width(width), m_next(first_row) {}

    Result<void> write_rows(int first_row, int row_count, std::span<const float* const> planes) override {
        EXPECT_EQ(first_row, m_next);
        if (first_row >= bad_row)
            return fail(ErrorCode::Io, "a full disk");
        m_next += row_count;
        rows.resize(planes.size());
        for (std::size_t p = 0; p < planes.size(); ++p)
            rows[p].insert(rows[p].end(), planes[p], planes[p] + row_count * m_width);
        return {};
    }

    int next_row() const { return m_next; }

    int bad_row = std::numeric_limits<int>::max();
    std::vector<std::vector<float>> rows;

  private:
    int m_width;
    int m_next;
};

const std::vector<double> kGrid{400, 450, 500, 550, 600, 650, 700};

TEST(CollapseStream, ResultDoesNotDependOnWorkersBlocksOrRange) {
    const auto plan = plan_of(set_of(Family::S0, kGrid), "to=lin_rec709").value();
    const int top = MemorySource::kTop;
    std::vector<std::vector<float>> expected;
    for (const int rows_per_block : {1, 3, 16, 100})
        for (const unsigned workers : {1U, 2U, 7U})
            for (const bool parallel : {false, true}) {
                const MemorySource source(13, 40, rows_per_block, kGrid.size() + 1);
                MemorySink sink(13, top);
                TestRunner runner(workers, parallel);
                const auto counts = collapse_stream(source, plan, true, {top, top + 39}, sink, runner, {});
                ASSERT_TRUE(counts) << counts.error().text();
                EXPECT_EQ(counts->pixels, 13U * 40U);
                EXPECT_EQ(source.reads, static_cast<int>(source.block_count()));
                if (expected.empty())
                    expected = sink.rows;
                EXPECT_EQ(sink.rows, expected);

                MemorySink part(13, top + 7);
                ASSERT_TRUE(collapse_stream(source, plan, true, {top + 7, top + 20}, part, runner, {}));
                for (std::size_t p = 0; p < 4; ++p)
                    EXPECT_TRUE(
                        std::equal(part.rows[p].begin(), part.rows[p].end(), expected[p].begin() + 7 * 13));
            }
}

/// Keeps what it is shown of one band, by the sums' first pixel of each piece.
class BandWitness final : public CollapseWitness {
  public:
    std::vector<const std::byte*> seen;

    std::unique_ptr<WitnessWorker> start_worker() override { return std::make_unique<Worker>(*this); }

  private:
    class Worker final : public WitnessWorker {
      public:
        explicit Worker(BandWitness& witness) : m_witness(witness) {}

        void look(std::span<const BandView> bands, std::size_t, std::span<const float* const>) override {
            m_witness.seen.push_back(bands[2].data);
        }

        void deliver() override {}

      private:
        BandWitness& m_witness;
    };
};

TEST(CollapseStream, BandsOfZerosChangeNoBitAndAreShownToWitnesses) {
    const auto plan = plan_of(set_of(Family::S0, kGrid), "to=xyz").value();
    const int top = MemorySource::kTop, width = 13, height = 40;
    MemorySource source(width, height, 4, kGrid.size());
    std::fill(source.m_data[2].begin(), source.m_data[2].end(), 0.0F);
    std::fill_n(source.m_data[3].begin(), 7 * width, 0.0F);
    std::fill_n(source.m_data[4].begin(), 7 * width, -0.0F);
    source.m_data[0][50] = std::numeric_limits<float>::infinity();
    source.m_data[5][60] = std::numeric_limits<float>::quiet_NaN();
    std::vector<BandView> bands;
    for (const auto& plane : source.m_data)
        bands.push_back({reinterpret_cast<const std::byte*>(plane.data()), SampleType::Float, 4});
    std::vector<std::vector<float>> expected(3, std::vector<float>(static_cast<std::size_t>(width * height)));
    std::vector<float*> rows;
    for (auto& row : expected)
        rows.push_back(row.data());
    collapse_run_reference(bands, plan.weights, expected[0].size(), rows);

    MemorySink sink(width, top);
    TestRunner runner(1, false);
    BandWitness witness;
    const CollapseTarget target{plan, sink, &witness};
    ASSERT_TRUE(collapse_stream(source, {&target, 1}, false, {top, top + height - 1}, runner, {}));
    for (std::size_t row = 0; row < 3; ++row)
        EXPECT_EQ(std::memcmp(sink.rows[row].data(), expected[row].data(), 4 * expected[row].size()), 0)
            << row;
    ASSERT_EQ(witness.seen.size(), source.block_count());
    for (std::size_t block = 0; block < witness.seen.size(); ++block)
        EXPECT_EQ(witness.seen[block], bands[2].advanced(block * 4 * width).data);
}

TEST(CollapseStream, SeveralPlansAreWhatEachWouldBeAndReadOnce) {
    std::vector<CollapsePlan> plans;
    for (const char* request : {"to=srgb&white=A", "to=lab", "to=xyz&extrapolate=zero", "to=luminance"})
        plans.push_back(plan_of(set_of(Family::S0, kGrid), request).value());
    MemorySource source(13, 40, 7, kGrid.size() + 1);
    source.m_data[2][100] = std::numeric_limits<float>::quiet_NaN();
    const int top = MemorySource::kTop;
    const RowRange rows{top + 3, top + 31};
    TestRunner runner(3, true);
    std::vector<MemorySink> together(plans.size(), MemorySink(13, top + 3));
    std::vector<CollapseTarget> targets;
    for (std::size_t i = 0; i < plans.size(); ++i)
        targets.push_back({plans[i], together[i]});
    const auto counts = collapse_stream(source, targets, true, rows, runner, {});
    ASSERT_TRUE(counts);
    EXPECT_EQ(source.reads,
              static_cast<int>(source.block_of_row(rows.last) - source.block_of_row(rows.first) + 1));
    const auto bits = [](const std::vector<float>& plane) {
        std::vector<std::uint32_t> out;
        for (const float sample : plane)
            out.push_back(std::bit_cast<std::uint32_t>(sample));
        return out;
    };
    for (std::size_t i = 0; i < plans.size(); ++i) {
        MemorySink alone(13, top + 3);
        const auto count = collapse_stream(source, plans[i], true, rows, alone, runner, {});
        ASSERT_TRUE(count);
        EXPECT_EQ((*counts)[i].nan, count->nan);
        EXPECT_EQ((*counts)[i].negative, count->negative);
        EXPECT_EQ((*counts)[i].pixels, count->pixels);
        ASSERT_EQ(together[i].rows.size(), alone.rows.size());
        for (std::size_t plane = 0; plane < alone.rows.size(); ++plane)
            EXPECT_EQ(bits(together[i].rows[plane]), bits(alone.rows[plane])) << i;
    }
    // A sink that fails ends it for all.
    std::vector<MemorySink> failing(2, MemorySink(13, top + 3));
    failing[1].bad_row = top + 8;
    const std::vector<CollapseTarget> two{{plans[0], failing[0]}, {plans[1], failing[1]}};
    EXPECT_EQ(collapse_stream(source, two, true, rows, runner, {}).error().code, ErrorCode::Io);
}

TEST(CollapseStream, AlphaPassesThroughAndLinearColourIsNotTouchedByIt) {
    const auto plan = plan_of(set_of(Family::S0, kGrid), "to=xyz").value();
    MemorySource source(5, 4, 4, kGrid.size() + 1);
    const int top = MemorySource::kTop;
    const auto run = [&] {
        MemorySink sink(5, top);
        TestRunner runner(1, false);
        EXPECT_TRUE(collapse_stream(source, plan, true, {top, top + 3}, sink, runner, {}));
        return sink.rows;
    };
    const auto before = run();
    EXPECT_EQ(before[3], source.m_data.back());
    std::fill(source.m_data.back().begin(), source.m_data.back().end(), 42.0F);
    const auto after = run();
    EXPECT_EQ(after[3], std::vector<float>(20, 42.0F));
    for (std::size_t p = 0; p < 3; ++p)
        EXPECT_EQ(before[p], after[p]);
}

TEST(CollapseStream, ACurveIsAppliedToUnassociatedColour) {
    const auto linear = plan_of(set_of(Family::S0, kGrid), "to=lin_rec709").value();
    const auto curved = plan_of(set_of(Family::S0, kGrid), "to=srgb").value();
    MemorySource source(4, 1, 1, kGrid.size() + 1);
    source.m_data.back() = {1.0F, 0.5F, 0.25F, 0.0F};
    const int top = MemorySource::kTop;
    const auto run = [&](const CollapsePlan& plan) {
        MemorySink sink(4, top);
        TestRunner runner(1, false);
        EXPECT_TRUE(collapse_stream(source, plan, true, {top, top}, sink, runner, {}));
        return sink.rows;
    };
    const auto a = run(linear), b = run(curved);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < 4; ++x) {
            const double alpha = static_cast<double>(source.m_data.back()[x]);
            const double share = alpha > 0 ? alpha : 1;
            const double expected = srgb_encode(static_cast<double>(a[c][x]) / share) * share;
            EXPECT_EQ(b[c][x], static_cast<float>(expected)) << c << " " << x;
        }
}

TEST(CollapseStream, NanStaysInItsPixelAndIsCounted) {
    const auto plan = plan_of(set_of(Family::S0, kGrid), "to=xyz").value();
    MemorySource source(8, 8, 3, kGrid.size());
    for (auto& plane : source.m_data)
        std::fill(plane.begin(), plane.end(), 0.5F);
    source.m_data[3][20] = std::numeric_limits<float>::quiet_NaN();
    source.m_data[3][30] = std::numeric_limits<float>::infinity();
    source.m_data[2][40] = -100;
    const int top = MemorySource::kTop;
    MemorySink sink(8, top);
    TestRunner runner(3, true);
    const auto counts = collapse_stream(source, plan, false, {top, top + 7}, sink, runner, {});
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->nan, 1U);
    EXPECT_EQ(counts->infinite, 1U);
    EXPECT_EQ(counts->negative, 1U);
    for (std::size_t i = 0; i < 64; ++i)
        EXPECT_EQ(std::isnan(sink.rows[1][i]), i == 20) << i;
}

TEST(CollapseStream, TheFirstFailureStopsTheWorkAndIsTold) {
    const auto plan = plan_of(set_of(Family::S0, kGrid), "to=xyz").value();
    const int top = MemorySource::kTop;
    for (const unsigned workers : {1U, 4U})
        for (const bool parallel : {false, true}) {
            MemorySource source(3, 400, 1, kGrid.size());
            TestRunner runner(workers, parallel);
            source.bad_block = 50;
            MemorySink sink(3, top);
            const auto damaged = collapse_stream(source, plan, false, {top, top + 399}, sink, runner, {});
            ASSERT_FALSE(damaged);
            EXPECT_EQ(damaged.error().what, "bad block 50");
            EXPECT_EQ(sink.next_row(), top + 50);
            EXPECT_LT(source.reads, 100);

            source.bad_block = 1000;
            MemorySink full(3, top);
            full.bad_row = top + 20;
            const auto io = collapse_stream(source, plan, false, {top, top + 399}, full, runner, {});
            ASSERT_FALSE(io);
            EXPECT_EQ(io.error().code, ErrorCode::Io);
            EXPECT_EQ(full.next_row(), top + 20);
        }
}

TEST(CollapseStream, ProgressGoesUpToOneAndCanCancel) {
    const auto plan = plan_of(set_of(Family::S0, kGrid), "to=xyz").value();
    const int top = MemorySource::kTop;
    const MemorySource source(3, 100, 10, kGrid.size());
    MemorySink sink(3, top);
    TestRunner runner(2, true);
    std::vector<double> seen;
    ASSERT_TRUE(collapse_stream(source, plan, false, {top, top + 99}, sink, runner, [&](double share) {
        seen.push_back(share);
        return true;
    }));
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), 1.0);

    MemorySink cut(3, top);
    const auto cancelled = collapse_stream(source, plan, false, {top, top + 99}, cut, runner,
                                           [](double share) { return share < 0.35; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
    EXPECT_EQ(cut.next_row(), top + 40);
}

}  // namespace
}  // namespace osio::test
