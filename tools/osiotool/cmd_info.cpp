// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/report.h>

#include <formats/image/open_image.h>

#include <fmt/format.h>

namespace osio::tool {

Result<ExitCode> run_info(const InfoOptions& options) {
    OSIO_TRY(const auto file, image::open_image(options.input));
    fmt::print("{}", options.json ? info_json(*file) : info_text(*file));
    return kDone;
}

}  // namespace osio::tool
