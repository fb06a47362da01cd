// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/convert.h>
#include <formats/exr/exr_writer.h>
#include <formats/exr/output_header.h>
#include <formats/image/open_image.h>
#include <formats/trade/cost.h>

#include <osio/collapse/kernel.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace osio::trade {

namespace {

RowRange rows_of(const image::CollapseJob& job) {
    return {job.part().data_window.min_y, job.part().data_window.max_y};
}

/// Sums by the obvious loop, or of some rows only: what collapse_stream() has no way to.
class PlainVisitor final : public BlockVisitor {
  public:
    PlainVisitor(const Choice& choice, int first_row, int width, RowSink& sink)
        : m_choice(choice), m_first_row(first_row), m_width(static_cast<std::size_t>(width)),
          m_worker(sink.start_worker()) {}

    void process(const PlanarBlock& block) override {
        m_rows.clear();
        m_pixels.clear();
        m_pixels.resize(static_cast<std::size_t>(block.row_count) * m_width * 3);
        block.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> bands) {
            for (std::size_t done = 0; done < count;) {
                const std::size_t at = first + done;
                const auto row = static_cast<int>(at / m_width);
                const std::size_t piece = std::min(count - done, m_width - at % m_width);
                if ((block.first_row + row - m_first_row) % m_choice.row_step == 0)
                    sum(bands, done, at, piece);
                done += piece;
            }
        });
        const std::size_t plane = static_cast<std::size_t>(block.row_count) * m_width;
        const std::array<const float*, 3> planes{m_pixels.data(), m_pixels.data() + plane,
                                                 m_pixels.data() + 2 * plane};
        m_status = m_worker->prepare(block.first_row, block.row_count, planes);
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        OSIO_CHECK_OK(m_status);
        return m_worker->deliver();
    }

  private:
    void sum(std::span<const BandView> bands, std::size_t from, std::size_t to, std::size_t count) {
        m_rows.clear();
        for (const BandView& band : bands)
            m_rows.push_back(band.advanced(from));
        const std::size_t plane = m_pixels.size() / 3;
        const std::array<float*, 3> out{m_pixels.data() + to, m_pixels.data() + plane + to,
                                        m_pixels.data() + 2 * plane + to};
        if (m_choice.level == Level::Reference)
            collapse_run_reference(m_rows, m_choice.weights, count, out);
        else
            collapse_run(m_rows, m_choice.weights, count, out);
    }

    const Choice& m_choice;
    int m_first_row;
    std::size_t m_width;
    std::unique_ptr<RowWorker> m_worker;
    std::vector<BandView> m_rows;
    std::vector<float> m_pixels;
    Result<void> m_status;
};

std::uint64_t bytes_of(const std::string& path) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    return error ? 0 : bytes;
}

}  // namespace

/// What a choice reads, and which planes of it.
struct Workbench::Source {
    std::string path;
    OpenWords words;
    std::size_t part = 0;
    image::PlaneChannels planes;
    WeightMatrix weights;
};

Workbench::Workbench(const image::CollapseJob& job, Choices choices, MemoryMeter meter,
                     files::TemporaryFolder folder)
    : m_job(job), m_choices(std::move(choices)), m_meter(std::move(meter)), m_folder(std::move(folder)) {}

Result<std::unique_ptr<Workbench>> Workbench::create(const image::CollapseJob& job, Choices choices,
                                                     MemoryMeter meter) {
    OSIO_TRY(files::TemporaryFolder folder, files::TemporaryFolder::create("trade"));
    return std::unique_ptr<Workbench>(
        new Workbench(job, std::move(choices), std::move(meter), std::move(folder)));
}

Result<std::string> Workbench::half_image(const OpenWords& words, Runner& runner, const Progress& progress) {
    if (m_half.empty()) {
        convert::Request request;
        request.input = m_job.file->path();
        request.words = words;
        request.output = m_folder.path("half.exr");
        request.part = std::to_string(m_job.part_index);
        request.set = m_job.plan.request.set;
        request.depth = SampleType::Half;
        OSIO_CHECK_OK(convert::convert(request, runner, progress));
        m_half = request.output;
    }
    return m_half;
}

Result<std::string> Workbench::colour_image(const TextLoader& load_text, Runner& runner,
                                            const Progress& progress) {
    if (!m_colour.empty())
        return m_colour;
    CollapseRequest request = m_job.plan.request;
    OSIO_TRY(request.to, find_output_space("xyz"));
    request.illuminant = "D65";
    request.white.clear();
    request.adaptation = CollapseRequest{}.adaptation;
    request.exposure_stops = 0;
    request.names = OutputNames::Xyz;
    OSIO_TRY(image::CollapseJob job, image::prepare_collapse(m_job.file, request, load_text));
    job.alpha.reset();
    std::vector<exr::OutputChannel> channels;
    for (const std::string& name : job.channel_names())
        channels.push_back({name, SampleType::Float});
    const std::string path = m_folder.path("colour.exr");
    OSIO_TRY(std::shared_ptr<exr::ExrWriter> writer,
             exr::ExrWriter::create(path, exr::collapsed_header(job), channels));
    exr::ExrSink sink(std::move(writer), SampleType::Float, job.part().data_window.width());
    OSIO_TRY(const auto source, job.open_source());
    OSIO_CHECK_OK(collapse_stream(*source, job.plan, false, rows_of(job), sink, runner, progress));
    OSIO_CHECK_OK(sink.finish());
    m_colour = path;
    return m_colour;
}

Result<Workbench::Source> Workbench::source_of(const Choice& choice, const TextLoader& load_text,
                                               Runner& runner, const Progress& progress) {
    Source out{m_job.file->path(), {}, m_job.part_index, {}, choice.weights};
    OSIO_TRY(out.words, load_open_words(m_job.plan.request, load_text));
    image::PlaneChannels planes = m_choices.planes;
    if (choice.input == Input::HalfImage) {
        OSIO_TRY(out.path, half_image(out.words, runner, progress));
        CollapseRequest request = m_job.plan.request;
        request.part.clear();
        out.words = {};
        OSIO_TRY(const auto file, image::open_image(out.path));
        OSIO_TRY(const image::CollapseJob job, image::prepare_collapse(file, request, load_text));
        out.part = job.part_index;
        planes.clear();
        for (const PlanColumn& column : job.plan.columns)
            planes.emplace_back(column.channel);
        planes.resize(m_choices.planes.size());
    } else if (choice.input == Input::ReducedImage) {
        return Source{choice.path, {}, 0, choice.file_planes, choice.weights};
    } else if (choice.input == Input::ColourImage) {
        OSIO_TRY(out.path, colour_image(load_text, runner, progress));
        out.part = 0;
        out.words = {};
        out.planes = {0, 1, 2};  // X, Y, Z are in the order of their names
        out.weights = WeightMatrix(3, 3);
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t c = 0; c < 3; ++c)
                out.weights.at(row, c) = choice.from_input.rows[row][c];
        return out;
    }
    for (std::size_t plane = 0; plane < planes.size(); ++plane)
        out.planes.push_back(choice.weights.needs(plane) ? planes[plane] : std::nullopt);
    return out;
}

Run Workbench::run_of(const Choice& choice, const Source& source, Runner& runner,
                      const Progress& progress) const {
    const SampleType type = choice.half_output ? SampleType::Half : SampleType::Float;
    Run run;
    run.open = [&source]() -> Result<std::unique_ptr<BlockSource>> {
        OSIO_TRY(const auto file, image::open_image(source.path, source.words));
        return file->make_block_source(source.part, source.planes, image::Grain::Block);
    };
    Choice summed = choice;
    summed.weights = source.weights;
    CollapsePlan plan = m_job.plan;
    plan.weights = source.weights;
    run.collapse = [summed = std::move(summed), plan = std::move(plan), &runner,
                    &progress](const BlockSource& blocks, RowRange rows, RowSink& sink) -> Result<void> {
        if (summed.level == Level::Reference || summed.row_step > 1) {
            const auto visitor = [&] {
                return std::make_unique<PlainVisitor>(summed, rows.first, blocks.width(), sink);
            };
            return visit_blocks(blocks, rows, runner, visitor, progress);
        }
        OSIO_CHECK_OK(collapse_stream(blocks, plan, false, rows, sink, runner, progress));
        return {};
    };
    run.header = exr::collapsed_header(m_job);
    run.channels = {{"R", type}, {"G", type}, {"B", type}};
    run.type = type;
    run.row_step = choice.row_step;
    run.output = m_folder.path("out.exr");
    return run;
}

Result<Cost> Workbench::measure(std::size_t choice, int runs, const TextLoader& load_text, Runner& runner,
                                const Progress& progress) {
    const Choice& what = m_choices.list[choice];
    OSIO_TRY(const Source source, source_of(what, load_text, runner, progress));
    const Run run = run_of(what, source, runner, progress);
    Cost out;
    OSIO_TRY(out.forecast, forecast_run(run, rows_of(m_job), runner.worker_count()));
    std::vector<Times> times;
    for (int i = 0; i < runs; ++i) {
        m_meter.restart();
        OSIO_TRY(const Times time, timed_run(run, rows_of(m_job), runner.worker_count()));
        times.push_back(time);
        out.peak_mb = std::max(out.peak_mb, m_meter.peak_mb());
    }
    std::sort(times.begin(), times.end(),
              [](const Times& a, const Times& b) { return a.total() < b.total(); });
    out.middle = times[times.size() / 2];
    out.all = {out.middle.total(), times.front().total(), times.back().total()};
    out.bytes_read = bytes_of(source.path);
    out.bytes_written = bytes_of(run.output);
    return out;
}

}  // namespace osio::trade
