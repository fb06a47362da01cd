// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/host_module/host_module.h>

namespace osio::host {

/// HostModule::examine.
[[nodiscard]] std::vector<Finding> examine_host(const std::string& plugin_folder);

}  // namespace osio::host
