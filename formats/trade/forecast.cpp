// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/output_header.h>
#include <formats/files/temporary_folder.h>
#include <formats/trade/forecast.h>

#include <osio/collapse/kernel.h>

#include <atomic>

namespace osio::trade {

namespace {

/// Planes in which something was read that is not zero.
using Filled = std::vector<std::atomic<bool>>;

/// A source that is watched for planes of zeros.
class WatchedSource final : public WrappedSource {
  public:
    WatchedSource(std::unique_ptr<BlockSource> source, Filled& filled)
        : WrappedSource(std::move(source)), m_filled(filled) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, inner().start_reader());
        return std::make_unique<Reader>(std::move(reader), m_filled);
    }

  private:
    class Reader final : public BlockReader {
      public:
        Reader(std::unique_ptr<BlockReader> reader, Filled& filled)
            : m_reader(std::move(reader)), m_filled(filled) {}

        [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
            OSIO_TRY(PlanarBlock out, m_reader->read(block));
            out.for_each_run([this](std::size_t, std::size_t count, std::span<const BandView> planes) {
                for (std::size_t plane = 0; plane < m_filled.size(); ++plane)
                    if (planes[plane].data != nullptr && !m_filled[plane] && !is_zero(planes[plane], count))
                        m_filled[plane] = true;
            });
            return out;
        }

      private:
        std::unique_ptr<BlockReader> m_reader;
        Filled& m_filled;
    };

    Filled& m_filled;
};

}  // namespace

Result<CollapseForecast> forecast_collapse(const image::CollapseJob& job, Runner& runner,
                                           const Progress& progress) {
    OSIO_TRY(const files::TemporaryFolder folder, files::TemporaryFolder::create("forecast"));
    Filled filled(job.plan.columns.size());
    Run run;
    run.open = [&]() -> Result<std::unique_ptr<BlockSource>> {
        OSIO_TRY(auto source, job.open_source());
        return std::make_unique<WatchedSource>(std::move(source), filled);
    };
    run.collapse = [&](const BlockSource& source, RowRange rows, RowSink& sink) -> Result<void> {
        OSIO_CHECK_OK(collapse_stream(source, job.plan, job.alpha.has_value(), rows, sink, runner, progress));
        return {};
    };
    run.header = exr::collapsed_header(job);
    for (const std::string& name : job.channel_names())
        run.channels.push_back({name, SampleType::Float});
    run.output = folder.path("out.exr");
    CollapseForecast out;
    const image::Window& window = job.part().data_window;
    OSIO_TRY(out.forecast, forecast_run(run, {window.min_y, window.max_y}, runner.worker_count()));
    for (std::size_t column = 0; column < filled.size(); ++column)
        if (job.plan.weights.needs(column) && !filled[column])
            out.zero_columns.push_back(column);
    return out;
}

}  // namespace osio::trade
