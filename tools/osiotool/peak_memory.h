// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace osio::tool {

/// Starts the process's peak of resident memory anew from what it has now (Linux: /proc/self/clear_refs).
void restart_peak_memory();

/// The peak since then, MB (10^6 bytes); 0 where the system does not tell.
[[nodiscard]] double peak_memory_mb();

}  // namespace osio::tool
