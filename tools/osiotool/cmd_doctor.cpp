// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>

#include <fmt/format.h>

#include <cstdlib>

namespace osio::tool {

Result<ExitCode> run_doctor() {
    fmt::print("osiotool {}\n", OSIO_VERSION);
    OSIO_TRY(const host::HostModule* const module, load_host_module());
    using Kind = host::Finding::Kind;
    bool healthy = true;
    for (const host::Finding& finding : module->examine(plugin_folder())) {
        const char* const label = finding.kind == Kind::Good   ? "ok:     "
                                  : finding.kind == Kind::Note ? "note:   "
                                                               : "problem:";
        fmt::print("{} {}\n", label, finding.text);
        healthy = healthy && finding.kind != Kind::Problem;
    }
    const char* const config = std::getenv("OCIO");
    fmt::print("note:    OCIO {}\n", config == nullptr
                                         ? std::string("is not set; colour conversions of oiiotool need "
                                                       "--colorconfig")
                                         : fmt::format("is {}", config));
    return healthy ? kDone : kDoesNotFit;
}

}  // namespace osio::tool
