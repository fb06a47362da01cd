// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/collapse_output.h>
#include <tools/osiotool/commands.h>
#include <tools/osiotool/frames.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/exr/soundness.h>
#include <formats/files/sequence.h>
#include <formats/files/text_file.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <chrono>

namespace osio::tool {

namespace {

/// The rows that cannot be decoded; an error where none can.
Result<std::vector<exr::BadRows>> missing_rows(const std::vector<image::CollapseJob>& jobs, RowRange rows,
                                               Runner& runner) {
    const image::CollapseJob& job = jobs.front();
    OSIO_TRY(const auto source, image::open_source(jobs, {}, image::Grain::Chunk));
    OSIO_TRY(auto bad, exr::find_bad_rows(*source, rows, runner, [](double) { return !interrupted(); }));
    if (exr::row_count(bad) == static_cast<std::size_t>(job.part().data_window.height()))
        return fail(ErrorCode::Damaged, "no row can be decoded; first: " + bad.front().why, job.file->path());
    return bad;
}

/// One way to write the result, and all that comes with it.
class Attempt {
  public:
    Attempt(const CollapseOptions& options, std::string label, const std::vector<image::CollapseJob>& jobs,
            const std::vector<exr::BadRows>& missing, host::StoredType type)
        : m_options(options), m_label(std::move(label)), m_jobs(jobs), m_missing(missing), m_type(type) {}

    /// Writes everything beside its place.
    Result<void> run(Runner& runner) {
        OSIO_CHECK_OK(open_certifiers(runner));
        OSIO_TRY(const auto source, open_source());
        OSIO_TRY(m_outputs, open_outputs(m_options, m_jobs, m_missing, m_type, certified()));
        std::vector<CollapseTarget> targets;
        for (std::size_t i = 0; i < m_jobs.size(); ++i)
            targets.push_back(
                {m_jobs[i].plan, *m_outputs[i].sink, certified() ? &m_certifiers[i]->witness() : nullptr});
        const image::CollapseJob& first = m_jobs.front();
        const image::Window& window = first.part().data_window;
        ProgressBar bar(m_label, !m_options.quiet);
        OSIO_TRY(const auto counts, collapse_stream(*source, targets, first.alpha.has_value(),
                                                    {window.min_y, window.max_y}, runner, std::ref(bar)));
        for (std::size_t i = 0; i < m_jobs.size(); ++i) {
            CollapseOutcome outcome{
                m_outputs[i].path, std::string(depth_name(m_type)), counts[i], 0, 0, m_missing, 0, {}};
            if (certified())
                outcome.certificate = m_certifiers[i]->certificate(m_outputs[i].path, counts[i]);
            m_outcomes.push_back(std::move(outcome));
        }
        return {};
    }

    /// NotCertified with the first result's reason, where one does not hold what was asked for.
    [[nodiscard]] Result<void> judge() const {
        for (std::size_t i = 0; i < m_outcomes.size(); ++i)
            if (const auto& certificate = m_outcomes[i].certificate;
                certificate && certificate->max_delta_e && !certificate->holds())
                return fail(ErrorCode::NotCertified, certificate->failure(m_jobs[i]), m_jobs[i].file->path());
        return {};
    }

    /// Puts everything in its place.
    Result<std::vector<CollapseOutcome>> finish() {
        for (std::size_t i = 0; i < m_outcomes.size(); ++i)
            OSIO_CHECK_OK(m_outputs[i].finish(m_outcomes[i]));
        return std::move(m_outcomes);
    }

  private:
    [[nodiscard]] bool certified() const { return !m_certifiers.empty(); }

    Result<void> open_certifiers(Runner& runner) {
        if (m_options.certificate.empty() && !m_jobs.front().plan.request.max_delta_e)
            return {};
        for (const image::CollapseJob& job : m_jobs) {
            OSIO_TRY(auto certifier,
                     image::Certifier::create(job, stored_depth(m_type), files::text_loader({}), runner,
                                              [](double) { return !interrupted(); }));
            m_certifiers.push_back(std::move(certifier));
        }
        return {};
    }

    Result<std::unique_ptr<BlockSource>> open_source() const {
        std::vector<CollapsePlan> beside;
        for (const auto& certifier : m_certifiers)
            beside.insert(beside.end(), certifier->alternatives().begin(), certifier->alternatives().end());
        if (m_missing.empty())
            return image::open_source(m_jobs, beside);
        OSIO_TRY(auto source, image::open_source(m_jobs, beside, image::Grain::Chunk));
        return exr::with_black_rows(std::move(source), m_missing, m_jobs.front().plane_types());
    }

    const CollapseOptions& m_options;
    std::string m_label;
    const std::vector<image::CollapseJob>& m_jobs;
    const std::vector<exr::BadRows>& m_missing;
    host::StoredType m_type;
    std::vector<std::unique_ptr<image::Certifier>> m_certifiers;
    std::vector<CollapseOutput> m_outputs;
    std::vector<CollapseOutcome> m_outcomes;
};

/// The first candidate that is certified as was asked for, in its place; the last one's reason where none is.
Result<std::vector<CollapseOutcome>>
collapse_certified(const CollapseOptions& options, const std::string& label,
                   const std::vector<image::CollapseJob>& jobs, const std::vector<exr::BadRows>& missing,
                   const std::vector<host::StoredType>& types, Runner& runner) {
    Result<void> verdict;
    for (const host::StoredType type : types) {
        Attempt attempt(options, label, jobs, missing, type);
        OSIO_CHECK_OK(attempt.run(runner));
        verdict = attempt.judge();
        if (verdict)
            return attempt.finish();
    }
    return tl::unexpected(std::move(verdict).error());
}

/// The certificates beside the images: one, or a list where there are several lights.
Result<void> write_certificates(const std::string& path, const std::vector<image::CollapseJob>& jobs,
                                const std::vector<CollapseOutcome>& outcomes) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < jobs.size(); ++i)
        texts.push_back(image::certificate_json(jobs[i], *outcomes[i].certificate, false));
    return files::write_text(path, texts.size() == 1 ? texts.front() : "[\n" + join(texts, ",\n") + "]\n");
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

Result<FrameOutcome> collapse_one(const CollapseOptions& options, const std::string& label) {
    const auto started = std::chrono::steady_clock::now();
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    const bool certified = request.max_delta_e || !options.certificate.empty();
    if (certified && options.allow_partial)
        return fail(ErrorCode::Usage,
                    "--allow-partial makes black rows of damaged ones, of which nothing can be certified");
    if (request.white_luminance && !certified)
        return fail(ErrorCode::Usage, "--white-luminance is for --max-delta-e and --certificate");
    OSIO_TRY(const auto jobs, image::open_collapses(options.input, request, files::text_loader({})));
    const image::CollapseJob& first = jobs.front();
    OSIO_TRY(const host::StoredType type, choose_depth(options, first.plan.space));
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    const image::Window& window = first.part().data_window;
    std::vector<exr::BadRows> missing;
    if (options.allow_partial) {
        OSIO_TRY(missing, missing_rows(jobs, {window.min_y, window.max_y}, runner));
    }
    OSIO_TRY(auto outcomes, collapse_certified(options, label, jobs, missing,
                                               depth_candidates(options, first.plan, type), runner));
    if (!options.certificate.empty())
        OSIO_CHECK_OK(write_certificates(options.certificate, jobs, outcomes));
    for (CollapseOutcome& outcome : outcomes)
        outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    report(options, jobs, outcomes);
    return FrameOutcome{missing.empty() ? kDone : kBadInput,
                        options.json ? outcomes_json(jobs, outcomes) : std::string()};
}

}  // namespace

Result<ExitCode> run_collapse(const CollapseOptions& options) {
    if (!options.frames.empty() && !options.certificate.empty() &&
        !files::has_frame_place(options.certificate))
        return fail(ErrorCode::Usage,
                    "with --frames the certificate's name needs a place for the frame's number too",
                    options.certificate);
    const auto run = [&options](const FrameFiles& files) {
        CollapseOptions one = options;
        if (files.frame)
            one.certificate = files::frame_name(options.certificate, *files.frame);
        one.input = files.inputs.front();
        one.output = files.output;
        return collapse_one(one, files.label);
    };
    return run_frames(options.frames, {{options.input}, options.output, options.output, {}}, options.json,
                      run);
}

}  // namespace osio::tool
