// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/exr/output_header.h>
#include <formats/exr/soundness.h>
#include <formats/files/text_file.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <array>
#include <chrono>

namespace osio::tool {

namespace {

using host::StoredType;

constexpr std::array<std::pair<std::string_view, StoredType>, 4> kDepths{{{"half", StoredType::Half},
                                                                          {"float", StoredType::Float},
                                                                          {"uint8", StoredType::Uint8},
                                                                          {"uint16", StoredType::Uint16}}};

std::string_view depth_name(StoredType type) {
    for (const auto& [name, known] : kDepths)
        if (known == type)
            return name;
    return {};
}

bool is_exr(std::string_view path) {
    return to_lower(path).ends_with(".exr");
}

bool is_integer(StoredType type) {
    return type == StoredType::Uint8 || type == StoredType::Uint16;
}

/// True where equal steps of the values are equal steps of light.
bool is_linear(const OutputSpace& space) {
    return space.transform ? space.transform->is_linear() : space.transfer == Transfer::Linear;
}

/// The depth that was asked for, else float for linear values and EXR, 8 bits for encoded ones.
Result<StoredType> choose_depth(const CollapseOptions& options, const OutputSpace& space) {
    StoredType type = StoredType::Float;
    if (options.depth.empty()) {
        type = !is_exr(options.output) && !is_linear(space) ? StoredType::Uint8 : StoredType::Float;
    } else {
        std::vector<std::string> names;
        bool found = false;
        for (const auto& [name, known] : kDepths) {
            names.emplace_back(name);
            if (iequals(name, options.depth)) {
                type = known;
                found = true;
            }
        }
        if (!found)
            return fail(ErrorCode::UnknownName,
                        "there is no depth \"" + options.depth + "\"" + suggestion(options.depth, names));
    }
    if (is_integer(type) && is_exr(options.output))
        return fail(ErrorCode::Usage, "an .exr stores half or float, not " + std::string(depth_name(type)));
    if (is_integer(type) && !is_tristimulus(space.kind))
        return fail(ErrorCode::Usage, space.id + " holds values beyond 0 to 1, which " +
                                          std::string(depth_name(type)) + " does not; use -d half or float");
    if (is_integer(type) && is_linear(space) && !options.raw)
        return fail(ErrorCode::Usage,
                    space.id + " is linear, and " + std::string(depth_name(type)) +
                        " has too few steps for it in the shadows; use --to srgb, -d half, or --raw "
                        "to do it all the same");
    return type;
}

files::Durability durability(const CollapseOptions& options) {
    return options.fsync ? files::Durability::Stored : files::Durability::Handed;
}

/// Where the rows go, and what is known when they are there.
struct Output {
    std::unique_ptr<RowSink> sink;
    std::function<Result<void>(CollapseOutcome&)> finish;
};

Result<Output> open_exr(const CollapseOptions& options, const exr::CollapseJob& job, Imf::Header header,
                        StoredType type) {
    if (!options.compression.empty()) {
        OSIO_TRY(header.compression(), exr::find_compression(options.compression));
    }
    const SampleType sample = type == StoredType::Half ? SampleType::Half : SampleType::Float;
    std::vector<exr::OutputChannel> channels;
    for (const std::string& name : job.channel_names())
        channels.push_back({name, sample});
    OSIO_TRY(auto writer, exr::ExrWriter::create(options.output, std::move(header), channels));
    auto sink = std::make_unique<exr::ExrSink>(std::move(writer), sample, job.part().data_window.width());
    auto* const exr = sink.get();
    return Output{std::move(sink), [exr, durability = durability(options)](CollapseOutcome& outcome) {
                      outcome.clamped_samples = exr->clamped_count();
                      return exr->finish(durability);
                  }};
}

Result<Output> open_other(const CollapseOptions& options, const exr::CollapseJob& job,
                          const Imf::Header& header, StoredType type) {
    if (!options.compression.empty())
        return fail(ErrorCode::Usage, "--compression is for .exr output");
    OSIO_TRY(const host::HostModule* const module, load_host_module());
    OSIO_TRY(auto sink,
             module->open_sink({options.output, type, job.channel_names(), &header, durability(options)}));
    auto* const other = sink.get();
    return Output{std::move(sink), [other](CollapseOutcome& outcome) {
                      outcome.clipped_pixels = other->clipped_pixels();
                      return other->finish();
                  }};
}

/// The rows that cannot be decoded; an error where none can.
Result<std::vector<exr::BadRows>> missing_rows(const exr::CollapseJob& job, RowRange rows, Runner& runner) {
    OSIO_TRY(const auto source, job.open_source(exr::Grain::Chunk));
    OSIO_TRY(auto bad, exr::find_bad_rows(*source, rows, runner, [](double) { return !interrupted(); }));
    if (exr::row_count(bad) == static_cast<std::size_t>(job.part().data_window.height()))
        return fail(ErrorCode::Damaged, "no row can be decoded; first: " + bad.front().why, job.file->path());
    return bad;
}

Result<std::unique_ptr<BlockSource>> open_source(const exr::CollapseJob& job,
                                                 const std::vector<exr::BadRows>& missing) {
    if (missing.empty())
        return job.open_source();
    OSIO_TRY(auto source, job.open_source(exr::Grain::Chunk));
    return exr::with_black_rows(std::move(source), missing, job.plane_types());
}

}  // namespace

Result<ExitCode> run_collapse(const CollapseOptions& options) {
    const auto started = std::chrono::steady_clock::now();
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    OSIO_TRY(const exr::CollapseJob job, exr::open_collapse(options.input, request, files::text_loader({})));
    OSIO_TRY(const StoredType type, choose_depth(options, job.plan.space));
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    const exr::Window& window = job.part().data_window;
    const RowRange rows{window.min_y, window.max_y};
    CollapseOutcome outcome;
    if (options.allow_partial) {
        OSIO_TRY(outcome.missing, missing_rows(job, rows, runner));
    }
    OSIO_TRY(const auto source, open_source(job, outcome.missing));
    Imf::Header header = exr::collapsed_header(job);
    exr::note_missing_rows(outcome.missing, header);
    OSIO_TRY(const Output output, is_exr(options.output) ? open_exr(options, job, header, type)
                                                         : open_other(options, job, header, type));

    outcome.output = options.output;
    outcome.type = depth_name(type);
    {
        ProgressBar bar(options.output, !options.quiet);
        OSIO_TRY(outcome.counts, collapse_stream(*source, job.plan, job.alpha.has_value(), rows, *output.sink,
                                                 runner, std::ref(bar)));
    }
    OSIO_CHECK_OK(output.finish(outcome));
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();

    if (!options.quiet) {
        for (const std::string& warning : job.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
        fmt::print(stderr, "{}", outcome_text(job, outcome));
    }
    if (!outcome.missing.empty())
        fmt::print(stderr, "osiotool: {}: {} of {} rows were damaged and are black in {}: {}; first: {}\n",
                   options.input, exr::row_count(outcome.missing), window.height(), options.output,
                   exr::rows_text(outcome.missing), outcome.missing.front().why);
    if (options.json)
        fmt::print("{}", outcome_json(job, outcome));
    return outcome.missing.empty() ? kDone : kBadInput;
}

}  // namespace osio::tool
