// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/peak_memory.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report_trade.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/files/text_file.h>

#include <fmt/format.h>

namespace osio::tool {

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
    trade::Table table;
    {
        ProgressBar bar(options.input, !options.quiet);
        OSIO_TRY(table, trade::make_table(job, options.runs, {restart_peak_memory, peak_memory_mb}, load_text,
                                          runner, std::ref(bar)));
    }
    if (!options.quiet)
        for (const std::string& warning : job.warnings)
            fmt::print(stderr, "warning: {}\n", warning);
    fmt::print("{}", options.json  ? trade_json(options.input, table)
                     : options.csv ? trade_csv(table)
                                   : trade_text(options.input, table));
    return kDone;
}

}  // namespace osio::tool
