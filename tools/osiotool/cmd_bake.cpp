// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/report.h>

#include <formats/files/matrix_file.h>
#include <formats/files/text_file.h>

#include <osio/base/text.h>

#include <fmt/format.h>

namespace osio::tool {

namespace {

Result<files::CubeDomain> domain_of(const BakeOptions& options) {
    files::CubeDomain domain;
    domain.size = options.size;
    if (options.domain.empty())
        return domain;
    const auto pieces = split(options.domain, ',');
    const auto low = pieces.size() == 2 ? parse_double(trim(pieces[0])) : std::nullopt;
    const auto high = pieces.size() == 2 ? parse_double(trim(pieces[1])) : std::nullopt;
    if (!low || !high)
        return fail(ErrorCode::Usage, "domain \"" + options.domain +
                                          "\" is no pair of numbers; expected LOW,HIGH, such as 0,16");
    domain.low = *low;
    domain.high = *high;
    return domain;
}

}  // namespace

Result<ExitCode> run_bake(const BakeOptions& options) {
    MatrixRequest request = options.request;
    OSIO_TRY(request.kind, find_matrix_kind(options.what));
    if (!options.adapt.empty()) {
        OSIO_TRY(request.adaptation, find_adaptation(options.adapt));
    }
    OSIO_TRY(const files::CubeDomain domain, domain_of(options));
    OSIO_TRY(const BakedMatrix baked, bake_matrix(request, files::text_loader({})));
    OSIO_CHECK_OK(files::write_matrix_file(baked, options.output, domain));
    if (options.json)
        fmt::print("{}", bake_json(baked, options.output));
    else
        fmt::print("{}", bake_text(baked));
    return kDone;
}

}  // namespace osio::tool
