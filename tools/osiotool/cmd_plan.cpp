// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>

#include <formats/files/text_file.h>

#include <fmt/format.h>

namespace osio::tool {

Result<ExitCode> run_plan(const PlanOptions& options) {
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    OSIO_TRY(const auto jobs, image::open_collapses(options.input, request, files::text_loader({})));
    if (options.json)
        fmt::print("{}", plans_json(jobs));
    else
        for (std::size_t i = 0; i < jobs.size(); ++i)
            fmt::print("{}{}", i == 0 ? "" : "\n", plan_text(jobs[i]));
    return kDone;
}

}  // namespace osio::tool
