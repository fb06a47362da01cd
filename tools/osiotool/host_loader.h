// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/host_module/host_module.h>

#include <osio/collapse/output_resolver.h>

#include <string>

namespace osio::tool {

/// The module that speaks to OpenImageIO, opened on first use and kept. Io with the loader's reason
/// where OpenImageIO is not installed.
[[nodiscard]] Result<const host::HostModule*> load_host_module();

/// Opens colour configs by the module that speaks to OpenColorIO, which is loaded when first asked.
[[nodiscard]] ConfigLoader colour_configs();

/// The folder of this installation that holds the plugins for OpenImageIO.
[[nodiscard]] std::string plugin_folder();

}  // namespace osio::tool
