// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/audit.h>
#include <tools/osiotool/commands.h>
#include <tools/osiotool/request_words.h>

#include <formats/image/open_image.h>

#include <fmt/format.h>

#include <algorithm>

namespace osio::tool {

namespace {

AuditedFile audit_file(const std::string& path, const OpenWords& words) {
    AuditedFile out;
    out.path = path;
    auto file = image::open_image(path, words);
    if (!file) {
        out.failure = std::move(file).error();
        return out;
    }
    out.format = (*file)->format();
    for (const image::Part& part : (*file)->parts())
        out.parts.push_back(audit_part(part));
    return out;
}

}  // namespace

Result<ExitCode> run_audit(const AuditOptions& options) {
    OSIO_TRY(const OpenWords words, open_words_of(options.request));
    std::vector<AuditedFile> files;
    ExitCode code = kDone;
    for (const std::string& path : options.inputs) {
        files.push_back(audit_file(path, words));
        if (files.back().failure)
            code = std::max(code, exit_code(files.back().failure->code));
        if (!options.json)
            fmt::print("{}", audit_text(files.back()));
    }
    if (options.json)
        fmt::print("{}", audit_json(files));
    return code;
}

}  // namespace osio::tool
