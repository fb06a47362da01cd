// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>

#include <formats/files/text_file.h>

#include <fmt/format.h>

namespace osio::tool {

Result<ExitCode> run_plan(const PlanOptions& options) {
    OSIO_TRY(const CollapseRequest request, request_of(options.request));
    OSIO_TRY(const auto job, exr::open_collapse(options.input, request, files::text_loader({})));
    fmt::print("{}", options.json ? plan_json(job) : plan_text(job));
    return kDone;
}

}  // namespace osio::tool
