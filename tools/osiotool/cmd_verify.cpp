// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/thread_runner.h>

#include <fmt/format.h>

#include <functional>

namespace osio::tool {

namespace {

/// Everything that can be known of one file; only an interruption is an error.
Result<FileSoundness> examine(const std::string& path, Runner& runner, bool show_progress) {
    FileSoundness out{path, nullptr, {}, std::nullopt};
    const auto file = exr::ExrFile::open(path);
    if (!file) {
        out.failure = file.error();
        return out;
    }
    out.file = *file;
    for (std::size_t part = 0; part < out.file->parts().size(); ++part) {
        ProgressBar bar(path, show_progress);
        auto soundness = exr::examine_part(out.file, part, runner, std::ref(bar));
        if (!soundness && soundness.error().code == ErrorCode::Cancelled)
            return tl::unexpected(std::move(soundness).error());
        if (!soundness) {
            out.failure = std::move(soundness).error();
            return out;
        }
        out.parts.push_back(std::move(*soundness));
    }
    return out;
}

}  // namespace

Result<ExitCode> run_verify(const VerifyOptions& options) {
    ThreadRunner runner(options.threads);
    catch_interrupts();
    std::vector<FileSoundness> files;
    ExitCode code = kDone;
    for (const std::string& path : options.inputs) {
        OSIO_TRY(FileSoundness file, examine(path, runner, !options.json));
        if (file.damaged())
            code = kBadInput;
        else if (file.failure && code == kDone)
            code = exit_code(file.failure->code);
        if (!options.json)
            fmt::print("{}", verify_text(file));
        files.push_back(std::move(file));
    }
    if (options.json)
        fmt::print("{}", verify_json(files));
    return code;
}

}  // namespace osio::tool
