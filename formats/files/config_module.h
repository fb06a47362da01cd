// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/output_resolver.h>

#include <string>

namespace osio::files {

/// Opens colour configs by the shared object at `path`, which is loaded when first asked and kept: what
/// needs no config pays nothing for OpenColorIO. Io with the system's reason where it cannot be loaded.
[[nodiscard]] ConfigLoader config_loader(std::string path);

/// The one symbol of that shared object.
inline constexpr const char* kConfigEntry = "osio_ocio_module";
using ConfigEntry = const ConfigLoader* (*)();

}  // namespace osio::files
