// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/files/text_file.h>

#include <fmt/format.h>

namespace osio::tool {

namespace {

Result<void> check_sizes(const image::ColourImage& a, const image::ColourImage& b) {
    const image::Window &wa = a.part().data_window, &wb = b.part().data_window;
    if (wa == wb)
        return {};
    const auto text = [](const image::Window& w) {
        return fmt::format("{}x{} pixels at {},{}", w.width(), w.height(), w.min_x, w.min_y);
    };
    return fail(ErrorCode::Unsupported,
                fmt::format("the images differ in size or place: {} is {}, {} is {}; crop or resize one",
                            a.file->path(), text(wa), b.file->path(), text(wb)));
}

Result<std::unique_ptr<exr::ExrSink>> open_map(const std::string& path, const image::Part& part) {
    const Imf::Header header(part.header.displayWindow(), part.header.dataWindow());
    const std::vector<exr::OutputChannel> channels{{"deltaE", SampleType::Float}};
    OSIO_TRY(auto writer, exr::ExrWriter::create(path, header, channels));
    return std::make_unique<exr::ExrSink>(std::move(writer), SampleType::Float, part.data_window.width());
}

/// idiff's verdict, and whether it is a failure.
std::pair<std::string, bool> judge(const DifferenceOptions& options, const DifferenceCounts& counts) {
    const std::uint64_t pixels = counts.delta_e.count() + counts.delta_e.undefined_count();
    const double allowed = options.fail_percent / 100 * static_cast<double>(pixels);
    if (options.fail && static_cast<double>(counts.beyond_fail) > allowed)
        return {"FAILURE", true};
    if (options.hard_fail &&
        (counts.delta_e.maximum() > *options.hard_fail || counts.delta_e.undefined_count() > 0))
        return {"FAILURE", true};
    if (options.warn && counts.beyond_warn > 0)
        return {"WARNING", false};
    return {options.fail || options.hard_fail || options.warn ? "PASS" : "", false};
}

}  // namespace

Result<ExitCode> run_difference(const DifferenceOptions& options) {
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    const TextLoader load_text = files::text_loader({});
    OSIO_TRY(const image::ColourImage a, image::open_colour_image(options.a, request, load_text));
    OSIO_TRY(const image::ColourImage b, image::open_colour_image(options.b, request, load_text));
    if (a.denied && b.denied)
        return tl::unexpected(*a.denied);
    if (!a.spectral && !b.spectral && !options.request.empty())
        for (const auto& [key, value] : options.request)
            if (key != "part")
                return fail(ErrorCode::UnexpectedIlluminant, "neither image holds bands, so --" + key + " " +
                                                                 value + " has nothing to work on");
    OSIO_CHECK_OK(check_sizes(a, b));
    OSIO_TRY(const auto source_a, a.open_source());
    OSIO_TRY(const auto source_b, b.open_source());

    ThreadRunner runner(options.threads);
    catch_interrupts();
    std::unique_ptr<exr::ExrSink> map;
    if (!options.map.empty()) {
        OSIO_TRY(map, open_map(options.map, a.part()));
    }
    DifferenceLimits limits;
    limits.fail = options.fail.value_or(limits.fail);
    limits.warn = options.warn.value_or(limits.warn);
    const image::Window& window = a.part().data_window;
    DifferenceOutcome outcome{a, b, {}, {}};
    {
        ProgressBar bar(options.a, !options.quiet);
        OSIO_TRY(outcome.counts,
                 difference_stream({*source_a, a.recipe}, {*source_b, b.recipe}, {window.min_y, window.max_y},
                                   limits, map.get(), runner, std::ref(bar)));
    }
    if (map) {
        OSIO_CHECK_OK(map->finish());
    }
    outcome.counts.largest_at[0] += window.min_x;
    const auto [verdict, failed] = judge(options, outcome.counts);
    outcome.verdict = verdict;

    for (const image::ColourImage* image : {&a, &b})
        if (!options.quiet)
            for (const std::string& warning : image->warnings)
                fmt::print(stderr, "warning: {}: {}\n", image->file->path(), warning);
    fmt::print("{}", options.json ? difference_json(outcome) : difference_text(outcome));
    return failed ? kDoesNotFit : kDone;
}

}  // namespace osio::tool
