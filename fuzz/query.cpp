// SPDX-License-Identifier: Apache-2.0
//
// A query is refused, or its request spells itself and reads back as the same request.
#include <plugins/common/open_options.h>

#include <fuzz/spelling.h>
#include <fuzz/target.h>
#include <string>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const std::string name = "no such file.exr?" + std::string(reinterpret_cast<const char*>(bytes), count);
    const auto open = osio::plugin::resolve_open(name, nullptr);
    if (open)
        osio::fuzz::check_spelling(open->request);
    return 0;
}
