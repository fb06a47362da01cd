// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>

#include <formats/files/text_file.h>

#include <osio/collapse/output_resolver.h>
#include <osio/collapse/request.h>
#include <osio/collapse/text_loader.h>

namespace osio::tool {

/// The request that some words make, in the order in which they were given.
[[nodiscard]] inline Result<CollapseRequest> request_of(const RequestWords& words) {
    CollapseRequest request;
    for (const auto& [key, value] : words)
        OSIO_CHECK_OK(set_option(request, key, value));
    OSIO_CHECK_OK(resolve_output(request, colour_configs()));
    return request;
}

/// What some words say of a file.
[[nodiscard]] inline Result<OpenWords> open_words_of(const RequestWords& words) {
    CollapseRequest request;
    for (const auto& [key, value] : words)
        OSIO_CHECK_OK(set_option(request, key, value));
    return load_open_words(request, files::text_loader({}));
}

}  // namespace osio::tool
