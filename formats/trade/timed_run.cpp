// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/timed.h>
#include <formats/trade/timed_run.h>

#include <algorithm>
#include <chrono>

namespace osio::trade {

namespace {

constexpr std::size_t kStrips = 4;
/// Of all blocks, those that a strip has; and at least so many for each worker, so that none waits long.
constexpr std::size_t kStripShare = 32, kBlocksPerWorker = 2;

/// Rows of a proxy are written only where they were made.
class EveryRowSink final : public RowSink {
  public:
    EveryRowSink(RowSink& sink, int first_row, int step, std::size_t width)
        : m_sink(sink), m_first_row(first_row), m_step(step), m_width(width) {}

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override {
        for (int row = 0; row < row_count; ++row) {
            const int y = first_row + row - m_first_row;
            if (y % m_step != 0)
                continue;
            std::vector<const float*> one;
            for (const float* plane : planes)
                one.push_back(plane + static_cast<std::size_t>(row) * m_width);
            OSIO_CHECK_OK(m_sink.write_rows(m_first_row + y / m_step, 1, one));
        }
        return {};
    }

  private:
    RowSink& m_sink;
    int m_first_row;
    int m_step;
    std::size_t m_width;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int count(RowRange rows) {
    return rows.last - rows.first + 1;
}

}  // namespace

Times& Times::operator+=(const Times& other) {
    open += other.open;
    decode += other.decode;
    collapse += other.collapse;
    write += other.write;
    return *this;
}

Result<Times> timed_run(const Run& run, RowRange rows, unsigned workers) {
    Imf::Header header = run.header;
    header.dataWindow().min.y = rows.first;
    header.dataWindow().max.y = rows.first + (rows.last - rows.first) / run.row_step;

    Times out;
    Stopwatch decode, write;
    const auto start = std::chrono::steady_clock::now();
    OSIO_TRY(auto blocks, run.open());
    OSIO_TRY(std::shared_ptr<exr::ExrWriter> writer,
             exr::ExrWriter::create(run.output, std::move(header), run.channels));
    out.open = seconds_since(start);
    const TimedSource source(std::move(blocks), decode);
    exr::ExrSink sink(std::move(writer), run.type, source.width());
    EveryRowSink proxy(sink, rows.first, run.row_step, static_cast<std::size_t>(source.width()));
    TimedSink timed_sink(run.row_step > 1 ? static_cast<RowSink&>(proxy) : sink, write);
    OSIO_CHECK_OK(run.collapse(source, rows, timed_sink));
    OSIO_CHECK_OK(write.time([&] { return sink.finish(); }));

    const double work = seconds_since(start) - out.open;
    out.decode = std::min(work, decode.seconds() / workers);
    out.write = std::min(work - out.decode, write.seconds() / workers);
    out.collapse = work - out.decode - out.write;
    return out;
}

std::vector<RowRange> forecast_strips(const BlockSource& source, RowRange rows, unsigned workers) {
    const std::size_t first = source.block_of_row(rows.first);
    const std::size_t blocks = source.block_of_row(rows.last) + 1 - first;
    const std::size_t height = std::max(kBlocksPerWorker * workers, blocks / kStripShare);
    if (kStrips * height >= blocks)
        return {rows};
    std::vector<RowRange> out;
    for (std::size_t strip = 0; strip < kStrips; ++strip) {
        const std::size_t at = first + (2 * strip + 1) * blocks / (2 * kStrips) - height / 2;
        out.push_back({std::max(rows.first, source.rows_of_block(at).first),
                       std::min(rows.last, source.rows_of_block(at + height - 1).last)});
    }
    return out;
}

Result<Forecast> forecast_run(const Run& run, RowRange rows, unsigned workers) {
    OSIO_TRY(const auto source, run.open());
    const std::vector<RowRange> strips = forecast_strips(*source, rows, workers);
    // What every run takes, however few its rows, is told by a shorter one: t = a + b rows.
    const std::size_t first = source->block_of_row(strips.front().first);
    const std::size_t last = std::min(first + workers - 1, source->block_of_row(rows.last));
    const RowRange few{strips.front().first, std::min(rows.last, source->rows_of_block(last).last)};
    OSIO_CHECK_OK(timed_run(run, few, workers));  // the first run of all pays for caches

    Forecast out{{}, 0, count(rows)};
    Times sum;
    for (const RowRange strip : strips) {
        OSIO_TRY(const Times times, timed_run(run, strip, workers));
        sum += times;
        out.rows_run += count(strip);
    }
    if (strips.size() == 1) {
        out.times = sum;
        return out;
    }
    OSIO_TRY(const Times least, timed_run(run, few, workers));
    const auto runs = static_cast<double>(strips.size());
    const auto line = [&](double Times::*part) {
        const double slope =
            std::max(0.0, (sum.*part - runs * (least.*part)) / (out.rows_run - runs * count(few)));
        return std::max(0.0, least.*part - slope * count(few)) + slope * out.rows;
    };
    out.times = {sum.open / runs, line(&Times::decode), line(&Times::collapse), line(&Times::write)};
    return out;
}

}  // namespace osio::trade
