// SPDX-License-Identifier: Apache-2.0
#include <formats/image/white_luminance.h>

#include <osio/base/value_statistics.h>
#include <osio/collapse/collapse_stream.h>

namespace osio::image {

namespace {

/// A white that is exceeded by highlights only.
constexpr double kWhitePercentile = 99;

/// Gathers one plane.
class StatisticsSink final : public RowSink {
  public:
    explicit StatisticsSink(std::size_t width) : m_width(width) {}

    [[nodiscard]] Result<void> write_rows(int, int row_count, std::span<const float* const> planes) override {
        for (std::size_t i = 0; i < static_cast<std::size_t>(row_count) * m_width; ++i)
            m_values.add(static_cast<double>(planes[0][i]));
        return {};
    }

    [[nodiscard]] const ValueStatistics& values() const { return m_values; }

  private:
    std::size_t m_width;
    ValueStatistics m_values;
};

Result<double> bright_luminance(const CollapseJob& job, const TextLoader& load_text, Runner& runner,
                                const Progress& progress) {
    CollapseRequest request = job.plan.request;
    OSIO_TRY(request.to, find_output_space("luminance"));
    request.names = OutputNames::Default;
    request.adaptation = CollapseRequest{}.adaptation;
    request.white.clear();
    OSIO_TRY(CollapseJob luminance, prepare_collapse(job.file, request, load_text));
    luminance.alpha.reset();
    OSIO_TRY(const auto source, luminance.open_source());
    StatisticsSink sink(static_cast<std::size_t>(job.part().data_window.width()));
    if (auto done = collapse_stream(*source, luminance.plan, false,
                                    {job.part().data_window.min_y, job.part().data_window.max_y}, sink,
                                    runner, progress);
        !done)
        return tl::unexpected(std::move(done).error());
    const double bright = sink.values().percentile(kWhitePercentile);
    return bright > 0 ? bright : 1.0;
}

}  // namespace

Result<WhiteLuminance> white_luminance_of(const CollapseJob& job, const TextLoader& load_text, Runner& runner,
                                          const Progress& progress) {
    const auto& requested = job.plan.request.white_luminance;
    if (requested)
        return WhiteLuminance{*requested, "as requested"};
    if (job.plan.illuminant)
        return WhiteLuminance{1, "the perfect diffuser"};
    OSIO_TRY(const double bright, bright_luminance(job, load_text, runner, progress));
    return WhiteLuminance{bright, "the 99th percentile of Y"};
}

}  // namespace osio::image
