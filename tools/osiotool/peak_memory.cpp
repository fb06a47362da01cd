// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/peak_memory.h>

#include <osio/base/text.h>

#include <fstream>
#include <string>

namespace osio::tool {

void restart_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
    constexpr std::string_view kKey = "VmHWM:";
    constexpr std::string_view kUnit = "kB";
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (!line.starts_with(kKey) || !line.ends_with(kUnit))
            continue;
        const std::string_view number(line.data() + kKey.size(), line.size() - kKey.size() - kUnit.size());
        // The kernel's kB are 1024 bytes.
        return parse_double(trim(number)).value_or(0) * 1024 / 1e6;
    }
    return 0;
}

}  // namespace osio::tool
