// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/plan_plot.h>
#include <tools/osiotool/progress_bar.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/report_explain.h>
#include <tools/osiotool/request_words.h>
#include <tools/osiotool/thread_runner.h>

#include <formats/exr/exr_writer.h>
#include <formats/files/text_file.h>

#include <fmt/format.h>

namespace osio::tool {

Result<ExitCode> run_plan(const PlanOptions& options) {
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    OSIO_TRY(const auto jobs, image::open_collapses(options.input, request, files::text_loader({})));
    if (options.svg && jobs.size() > 1)
        return fail(ErrorCode::Usage,
                    "--svg draws the plan of one light; this request has " + std::to_string(jobs.size()));
    std::vector<Explained> explained;
    if (options.explain) {
        ThreadRunner runner(options.threads);
        exr::set_compression_threads(runner.worker_count());
        catch_interrupts();
        for (const image::CollapseJob& job : jobs) {
            const auto go_on = [](double) { return !interrupted(); };
            OSIO_TRY(auto forecast, trade::forecast_collapse(job, runner, go_on));
            explained.push_back({image::explain(job), std::move(forecast), runner.worker_count()});
        }
    }
    if (options.svg)
        OSIO_CHECK_OK(files::write_text(*options.svg, plan_plot(jobs.front())));
    if (options.json)
        fmt::print("{}", plans_json(jobs, explained));
    else
        for (std::size_t i = 0; i < jobs.size(); ++i)
            fmt::print("{}{}", i == 0 ? "" : "\n",
                       options.explain ? explain_text(jobs[i], explained[i]) : plan_text(jobs[i]));
    return kDone;
}

}  // namespace osio::tool
