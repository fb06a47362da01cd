// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>

#include <cstdlib>
#include <fmt/format.h>

namespace osio::tool {

Result<ExitCode> run_doctor() {
    fmt::print("osiotool {}\n", OSIO_VERSION);
    OSIO_TRY(const host::HostModule* const module, load_host_module());
    bool healthy = true;
    for (const host::Finding& finding : module->examine(plugin_folder())) {
        fmt::print("{} {}\n", finding.good ? "ok:     " : "problem:", finding.text);
        healthy = healthy && finding.good;
    }
    const char* const config = std::getenv("OCIO");
    fmt::print("note:    OCIO {}\n",
               config == nullptr ? std::string("is not set; colour conversions of oiiotool need "
                                               "--colorconfig")
                                 : fmt::format("is {}", config));
    return healthy ? kDone : kDoesNotFit;
}

}  // namespace osio::tool
