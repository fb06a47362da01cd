// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/exr/output_header.h>
#include <formats/files/text_file.h>
#include <formats/image/colour_attributes.h>
#include <formats/image/header_attributes.h>

#include <osio/base/text.h>
#include <osio/collapse/photometric_weights.h>

#include <fmt/format.h>

#include <cmath>

namespace osio::tool {

namespace {

constexpr std::string_view kUnits = "W.m^-2.sr^-1";

/// Gathers what the rows say, and hands luminances on.
class PhotometrySink final : public RowSink {
  public:
    PhotometrySink(std::size_t width, exr::ExrSink* image) : m_width(width), m_image(image) {}

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override {
        const std::size_t pixels = static_cast<std::size_t>(row_count) * m_width;
        for (std::size_t i = 0; i < pixels; ++i) {
            const double luminance = static_cast<double>(planes[0][i]);
            m_luminance.add(luminance);
            if (!std::isfinite(luminance))
                continue;
            m_scotopic += static_cast<double>(planes[1][i]);
            m_radiance += static_cast<double>(planes[2][i]);
        }
        return m_image == nullptr ? Result<void>{}
                                  : m_image->write_rows(first_row, row_count, planes.first(2));
    }

    void fill(PhotometryOutcome& outcome) {
        const auto count = static_cast<double>(std::max<std::uint64_t>(1, m_luminance.count()));
        outcome.scotopic_mean = m_scotopic / count;
        outcome.radiance_mean = m_radiance / count;
        outcome.luminance = std::move(m_luminance);
    }

  private:
    std::size_t m_width;
    exr::ExrSink* m_image;
    ValueStatistics m_luminance;
    double m_scotopic = 0;
    double m_radiance = 0;
};

Result<std::unique_ptr<exr::ExrSink>> open_image(const std::string& path, const image::CollapseJob& job) {
    if (!to_lower(path).ends_with(".exr"))
        return fail(ErrorCode::Usage, "a luminance image is written as .exr", path);
    Imf::Header header = exr::collapsed_header(job);
    image::erase_attributes({image::attribute::kChromaticities, image::attribute::kColorSpace,
                             image::attribute::kRecipe, image::attribute::kPlan},
                            header);
    const std::vector<exr::OutputChannel> channels{{"Y", SampleType::Float},
                                                   {"Yscotopic", SampleType::Float}};
    OSIO_TRY(auto writer, exr::ExrWriter::create(path, std::move(header), channels));
    return std::make_unique<exr::ExrSink>(std::move(writer), SampleType::Float,
                                          job.part().data_window.width());
}

Result<ExitCode> photometry_of_light(const PhotometryOptions& options, const CollapseRequest& request) {
    if (request.illuminant.empty())
        return fail(ErrorCode::Usage, "name a spectral file, or a light with --illuminant");
    LightOutcome outcome;
    OSIO_TRY(outcome.light, load_illuminant(request.illuminant, files::text_loader({})));
    OSIO_TRY(const Observer observer, find_observer("cie1931"));
    OSIO_TRY(const Vector3 white, white_point(outcome.light, observer));
    outcome.photometry = photometry_of(outcome.light.power);
    outcome.xy = xy_of(white, white);
    if (const auto temperature = colour_temperature(uv_of(white, white)))
        outcome.temperature = *temperature;
    fmt::print("{}", options.json ? light_json(outcome) : light_text(outcome));
    return kDone;
}

}  // namespace

Result<ExitCode> run_photometry(const PhotometryOptions& options) {
    OSIO_TRY(CollapseRequest request, request_of(options.request));
    if (options.input.empty())
        return photometry_of_light(options, request);
    OSIO_TRY(request.to, find_output_space("xyz"));
    OSIO_TRY(image::CollapseJob job, image::open_collapse(options.input, request, files::text_loader({})));
    if (job.plan.illuminant)
        return fail(ErrorCode::Unsupported,
                    "set " + job.plan.request.set +
                        " is a reflectance, a ratio without luminance; expected radiance (S0)",
                    options.input);
    job.plan.weights = photometric_weights(job.plan);
    job.alpha.reset();
    const std::string units = job.part().metadata.emissive_units.value_or(std::string(kUnits));
    if (units != kUnits)
        job.warnings.push_back("emissiveUnits is \"" + units + "\"; cd/m2 are right for " +
                               std::string(kUnits) + " per nm");

    OSIO_TRY(const auto source, job.open_source());
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    std::unique_ptr<exr::ExrSink> image;
    if (!options.output.empty()) {
        OSIO_TRY(image, open_image(options.output, job));
    }
    const image::Window& window = job.part().data_window;
    PhotometrySink sink(static_cast<std::size_t>(window.width()), image.get());
    {
        ProgressBar bar(options.input, !options.quiet);
        const auto done = collapse_stream(*source, job.plan, false, {window.min_y, window.max_y}, sink,
                                          runner, std::ref(bar));
        if (!done)
            return tl::unexpected(done.error());
    }
    if (image) {
        OSIO_CHECK_OK(image->finish());
    }
    PhotometryOutcome outcome;
    outcome.input = options.input;
    outcome.set = job.plan.request.set;
    outcome.warnings = job.warnings;
    sink.fill(outcome);
    if (!options.quiet)
        for (const std::string& warning : job.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
    fmt::print("{}", options.json ? photometry_json(outcome) : photometry_text(outcome));
    return kDone;
}

}  // namespace osio::tool
