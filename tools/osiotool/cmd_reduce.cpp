// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report_reduce.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/files/text_file.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <chrono>

namespace osio::tool {

namespace {

/// Names between commas, none of them empty.
Result<std::vector<std::string>> names_of(const std::string& option, const std::string& value) {
    std::vector<std::string> out;
    for (const std::string_view name : split(value, ',')) {
        if (trim(name).empty())
            return fail(ErrorCode::Usage, "found " + option + " \"" + value + "\" with an empty name");
        out.emplace_back(trim(name));
    }
    return out;
}

}  // namespace

Result<ExitCode> run_reduce(const ReduceOptions& options) {
    const auto started = std::chrono::steady_clock::now();
    reduce::Request request;
    request.input = options.input;
    request.output = options.output;
    OSIO_TRY(request.words, request_of(options.request));
    if (!options.lights.empty()) {
        OSIO_TRY(request.lights, names_of("--lights", options.lights));
    }
    OSIO_TRY(request.observers, names_of("--observers", options.observers));
    request.tolerance = options.tolerance;
    request.scene_basis = options.scene_basis;
    request.compression = options.compression;
    request.durability = options.fsync ? files::Durability::Stored : files::Durability::Handed;
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    reduce::Outcome outcome;
    {
        ProgressBar bar(options.output, !options.quiet);
        OSIO_TRY(outcome, reduce::reduce(request, files::text_loader({}), runner, std::ref(bar)));
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    if (!options.quiet) {
        for (const std::string& warning : outcome.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
        fmt::print(stderr, "{}", reduce_text(outcome, seconds));
    }
    if (options.json)
        fmt::print("{}", reduce::outcome_json(outcome, seconds));
    return kDone;
}

}  // namespace osio::tool
