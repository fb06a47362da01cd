// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <chrono>

namespace osio::tool {

namespace {

/// The words of the command line as a request.
Result<convert::Request> request_of(const ConvertOptions& options) {
    convert::Request out;
    out.input = options.input;
    out.output = options.output;
    OSIO_TRY(out.words, open_words_of(options.request));
    out.part = options.part;
    out.set = options.set;
    out.compression = options.compression;
    if (!options.bands.empty()) {
        OSIO_TRY(out.bands, convert::parse_range(options.bands));
    }
    if (!options.depth.empty()) {
        if (iequals(options.depth, "half"))
            out.depth = SampleType::Half;
        else if (iequals(options.depth, "float"))
            out.depth = SampleType::Float;
        else
            return fail(ErrorCode::UnknownName,
                        "there is no depth \"" + options.depth + "\" of bands; expected half or float");
    }
    if (!options.interleave.empty()) {
        out.interleave = envi::find_interleave(options.interleave);
        if (!out.interleave)
            return fail(ErrorCode::UnknownName,
                        "there is no interleave \"" + options.interleave + "\"; expected bsq, bil or bip");
    }
    return out;
}

}  // namespace

Result<ExitCode> run_convert(const ConvertOptions& options) {
    const auto started = std::chrono::steady_clock::now();
    OSIO_TRY(const convert::Request request, request_of(options));
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    ConvertReport report;
    report.input = options.input;
    {
        ProgressBar bar(options.output, !options.quiet);
        OSIO_TRY(report.outcome, convert::convert(request, runner, std::ref(bar)));
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    if (!options.quiet) {
        for (const std::string& warning : report.outcome.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
        fmt::print(stderr, "{}", convert_text(report));
    }
    if (options.json)
        fmt::print("{}", convert_json(report));
    return kDone;
}

}  // namespace osio::tool
