// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/frames.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>

#include <osio/base/text.h>
#include <osio/collapse/request.h>

#include <fmt/format.h>

#include <chrono>

namespace osio::tool {

namespace {

constexpr int kMostTilePixels = 65536;

Result<exr::TileSize> parse_tile(const std::string& text) {
    const auto pieces = split(text, 'x');
    const auto width = parse_int(pieces.front());
    const auto height = parse_int(pieces.back());
    if (pieces.size() != 2 || !width || !height || *width < 1 || *height < 1 || *width > kMostTilePixels ||
        *height > kMostTilePixels)
        return fail(ErrorCode::Usage, "found tile \"" + text + "\", expected width and height such as 64x64");
    return exr::TileSize{*width, *height};
}

Result<Resampling> resampling_of(const ConvertOptions& options) {
    Resampling out;
    OSIO_TRY(out.grid, parse_wavelength_grid(options.resample));
    CollapseRequest words;  // the same words and the same refusals as those of a collapse
    if (!options.basis.empty())
        OSIO_CHECK_OK(set_option(words, "basis", options.basis));
    if (!options.extrapolate.empty())
        OSIO_CHECK_OK(set_option(words, "extrapolate", options.extrapolate));
    out.basis = words.basis;
    out.extrapolation = words.extrapolation;
    return out;
}

Result<std::optional<SampleType>> depth_of(const ConvertOptions& options) {
    if (options.depth.empty())
        return options.half ? std::optional(SampleType::Half) : std::nullopt;
    for (const SampleType type : {SampleType::Half, SampleType::Float})
        if (iequals(options.depth, sample_type_name(type))) {
            if (options.half && type != SampleType::Half)
                return fail(ErrorCode::Usage, "--half and -d " + options.depth + " contradict each other");
            return std::optional(type);
        }
    return fail(ErrorCode::UnknownName,
                "there is no depth \"" + options.depth + "\" of bands; expected half or float");
}

Result<std::optional<convert::Split>> split_of(const std::string& word) {
    if (word.empty())
        return std::optional<convert::Split>();
    if (iequals(word, "bands"))
        return std::optional(convert::Split::Bands);
    if (iequals(word, "sets"))
        return std::optional(convert::Split::Sets);
    return fail(ErrorCode::UnknownName, "there is no split by \"" + word + "\"; expected bands or sets");
}

/// The words of the command line as a request; its files come later.
Result<convert::Request> request_of(const ConvertOptions& options) {
    convert::Request out;
    OSIO_TRY(out.words, open_words_of(options.request));
    out.part = options.part;
    out.set = options.set;
    out.compression = options.compression;
    out.preview = options.preview;
    out.multi_part = options.multi_part;
    out.durability = options.fsync ? files::Durability::Stored : files::Durability::Handed;
    if (!options.bands.empty()) {
        OSIO_TRY(out.bands, convert::parse_range(options.bands));
    }
    if (!options.resample.empty()) {
        OSIO_TRY(out.resampling, resampling_of(options));
    } else if (!options.basis.empty() || !options.extrapolate.empty()) {
        return fail(ErrorCode::Usage, "--basis and --extrapolate are for --resample");
    }
    OSIO_TRY(out.depth, depth_of(options));
    OSIO_TRY(out.split, split_of(options.split));
    if (out.split == convert::Split::Sets && !options.set.empty())
        return fail(ErrorCode::Usage, "--split sets makes a file of every set, --set chooses one");
    if (!options.tile.empty()) {
        OSIO_TRY(out.tile, parse_tile(options.tile));
    }
    if (!options.interleave.empty()) {
        out.interleave = envi::find_interleave(options.interleave);
        if (!out.interleave)
            return fail(ErrorCode::UnknownName,
                        "there is no interleave \"" + options.interleave + "\"; expected bsq, bil or bip");
    }
    return out;
}

Result<FrameOutcome> convert_one(const ConvertOptions& options, convert::Request request,
                                 const FrameFiles& files) {
    const auto started = std::chrono::steady_clock::now();
    request.input = files.inputs.front();
    request.joined.assign(files.inputs.begin() + 1, files.inputs.end());
    request.output = files.output;
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    ConvertReport report;
    report.input = request.input;
    {
        ProgressBar bar(files.label, !options.quiet);
        OSIO_TRY(report.outcome, convert::convert(request, runner, std::ref(bar)));
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    if (!options.quiet) {
        for (const std::string& warning : report.outcome.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
        fmt::print(stderr, "{}", convert_text(report));
    }
    return FrameOutcome{kDone, options.json ? convert_json(report) : std::string()};
}

}  // namespace

Result<ExitCode> run_convert(const ConvertOptions& options) {
    OSIO_TRY(const convert::Request request, request_of(options));
    FrameFiles files{
        {options.files.begin(), options.files.end() - 1}, options.files.back(), options.files.back(), {}};
    if (files.inputs.size() > 1 && !options.assemble)
        return fail(ErrorCode::Usage, "found " + std::to_string(files.inputs.size()) +
                                          " inputs, expected one; --assemble puts several into one output");
    const auto run = [&](const FrameFiles& one) { return convert_one(options, request, one); };
    return run_frames(options.frames, files, options.json, run);
}

}  // namespace osio::tool
