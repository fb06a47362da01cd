// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>

#include <osio/collapse/output_resolver.h>
#include <osio/collapse/request.h>

namespace osio::tool {

/// The request that some words make, in the order in which they were given.
[[nodiscard]] inline Result<CollapseRequest> request_of(const RequestWords& words) {
    CollapseRequest request;
    for (const auto& [key, value] : words)
        OSIO_CHECK_OK(set_option(request, key, value));
    OSIO_CHECK_OK(resolve_output(request, colour_configs()));
    return request;
}

}  // namespace osio::tool
