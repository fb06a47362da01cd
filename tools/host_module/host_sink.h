// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/host_module/host_module.h>

namespace osio::host {

/// HostModule::open_sink.
[[nodiscard]] Result<std::unique_ptr<HostSink>> open_host_sink(const HostImage& image);

}  // namespace osio::host
