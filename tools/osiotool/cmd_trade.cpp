// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/peak_memory.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report_trade.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>
#include <tools/osiotool/trade_page.h>

#include <formats/exr/exr_writer.h>
#include <formats/files/text_file.h>

#include <osio/base/text.h>

#include <fmt/format.h>

#include <optional>

namespace osio::tool {

namespace {

/// The share of the work that making choices is, about, and, with measuring, where a page is made too.
constexpr double kChoicesShare = 0.15, kTableShare = 0.85;

/// The page's place, made sure of before minutes are spent on measuring.
Result<std::optional<files::ReplacementFile>> open_page(const std::string& path) {
    std::optional<files::ReplacementFile> out;
    if (path.empty())
        return out;
    const std::string name = to_lower(path);
    if (!name.ends_with(".html") && !name.ends_with(".htm"))
        return fail(ErrorCode::Usage, "\"" + path + "\" is no .html, which --html writes");
    OSIO_TRY(files::ReplacementFile file, files::ReplacementFile::create(path));
    out.emplace(std::move(file));
    return out;
}

}  // namespace

Result<ExitCode> run_trade(const TradeOptions& options) {
    if (options.runs < 1)
        return fail(ErrorCode::Usage,
                    "--runs " + std::to_string(options.runs) + " measures nothing; expected 1 or more");
    if (options.json && options.csv)
        return fail(ErrorCode::Usage, "--json and --csv both want stdout; expected one of them");
    OSIO_TRY(CollapseRequest request, request_of(options.request));
    if (!request.to && request.config_space.empty()) {
        OSIO_TRY(request.to, find_output_space("lin_rec709"));
    }
    const TextLoader load_text = files::text_loader({});
    OSIO_TRY(const image::CollapseJob job, image::open_collapse(options.input, request, load_text));
    ThreadRunner runner(options.threads);
    exr::set_compression_threads(runner.worker_count());
    catch_interrupts();
    OSIO_TRY(std::optional<files::ReplacementFile> page_file, open_page(options.html));
    trade::Table table;
    std::string page;
    {
        ProgressBar bar(options.input, !options.quiet);
        const auto part = [&bar](double from, double to) {
            return [&bar, from, to](double done) { return bar(from + (to - from) * done); };
        };
        const double measured = page_file ? kTableShare : 1;
        OSIO_TRY(const trade::AllChoices all,
                 trade::make_all_choices(job, load_text, runner, part(0, kChoicesShare)));
        OSIO_TRY(table, trade::make_table(job, all, options.runs, {restart_peak_memory, peak_memory_mb},
                                          load_text, runner, part(kChoicesShare, measured)));
        if (page_file) {
            OSIO_TRY(
                const trade::PageContent content,
                trade::make_page_content(job, all.choices, kMostPageStreamBytes, runner, part(measured, 1)));
            page = trade_page(job, table, content);
        }
    }
    if (!options.quiet)
        for (const std::string& warning : job.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
    fmt::print("{}", options.json  ? trade_json(options.input, table)
                     : options.csv ? trade_csv(table)
                                   : trade_text(options.input, table));
    if (page_file) {
        OSIO_CHECK_OK(files::write_text(std::move(*page_file), page));
    }
    return kDone;
}

}  // namespace osio::tool
