// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/collapse_output.h>
#include <tools/osiotool/commands.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/exr/soundness.h>
#include <formats/files/text_file.h>

#include <fmt/format.h>

#include <chrono>

namespace osio::tool {

namespace {

/// The rows that cannot be decoded; an error where none can.
Result<std::vector<exr::BadRows>> missing_rows(const std::vector<image::CollapseJob>& jobs, RowRange rows,
                                               Runner& runner) {
    const image::CollapseJob& job = jobs.front();
    OSIO_TRY(const auto source, image::open_source(jobs, image::Grain::Chunk));
    OSIO_TRY(auto bad, exr::find_bad_rows(*source, rows, runner, [](double) { return !interrupted(); }));
    if (exr::row_count(bad) == static_cast<std::size_t>(job.part().data_window.height()))
        return fail(ErrorCode::Damaged, "no row can be decoded; first: " + bad.front().why, job.file->path());
    return bad;
}

Result<std::unique_ptr<BlockSource>> open_source(const std::vector<image::CollapseJob>& jobs,
                                                 const std::vector<exr::BadRows>& missing) {
    if (missing.empty())
        return image::open_source(jobs);
    OSIO_TRY(auto source, image::open_source(jobs, image::Grain::Chunk));
    return exr::with_black_rows(std::move(source), missing, jobs.front().plane_types());
}

/// What a user is told, but for what --json prints.
void report(const CollapseOptions& options, const std::vector<image::CollapseJob>& jobs,
            const std::vector<CollapseOutcome>& outcomes) {
    if (!options.quiet)
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            for (const std::string& warning : jobs[i].warnings)
                fmt::print(stderr, "warning: {}\n", warning);
            fmt::print(stderr, "{}", outcome_text(jobs[i], outcomes[i]));
        }
    const std::vector<exr::BadRows>& missing = outcomes.front().missing;
    if (!missing.empty())
        fmt::print(stderr, "osiotool: {}: {} of {} rows were damaged and are black in {}: {}; first: {}\n",
                   options.input, exr::row_count(missing), jobs.front().part().data_window.height(),
                   options.output, exr::rows_text(missing), missing.front().why);
}

}  // namespace

Result<ExitCode> run_collapse(const CollapseOptions& options) {
    const auto started = std::chrono::steady_clock::now();
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    OSIO_TRY(const auto jobs, image::open_collapses(options.input, request, files::text_loader({})));
    const image::CollapseJob& first = jobs.front();
    OSIO_TRY(const host::StoredType type, choose_depth(options, first.plan.space));
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    const image::Window& window = first.part().data_window;
    const RowRange rows{window.min_y, window.max_y};
    std::vector<exr::BadRows> missing;
    if (options.allow_partial) {
        OSIO_TRY(missing, missing_rows(jobs, rows, runner));
    }
    OSIO_TRY(const auto source, open_source(jobs, missing));
    OSIO_TRY(const auto outputs, open_outputs(options, jobs, missing, type));
    std::vector<CollapseTarget> targets;
    for (std::size_t i = 0; i < jobs.size(); ++i)
        targets.push_back({jobs[i].plan, *outputs[i].sink});

    std::vector<CollapseCounts> counts;
    {
        ProgressBar bar(options.output, !options.quiet);
        OSIO_TRY(counts,
                 collapse_stream(*source, targets, first.alpha.has_value(), rows, runner, std::ref(bar)));
    }
    std::vector<CollapseOutcome> outcomes;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        CollapseOutcome outcome{outputs[i].path, std::string(depth_name(type)), counts[i], 0, 0, missing, 0};
        OSIO_CHECK_OK(outputs[i].finish(outcome));
        outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
        outcomes.push_back(std::move(outcome));
    }
    report(options, jobs, outcomes);
    if (options.json)
        fmt::print("{}", outcomes_json(jobs, outcomes));
    return missing.empty() ? kDone : kBadInput;
}

}  // namespace osio::tool
