// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/request_words.h>

#include <formats/image/open_image.h>

#include <fmt/format.h>

namespace osio::tool {

Result<ExitCode> run_info(const InfoOptions& options) {
    OSIO_TRY(const OpenWords words, open_words_of(options.request));
    OSIO_TRY(const auto file, image::open_image(options.input, words));
    fmt::print("{}", options.json ? info_json(*file) : info_text(*file));
    return kDone;
}

}  // namespace osio::tool
