// SPDX-License-Identifier: Apache-2.0
//
// A recipe is refused, or its request spells itself and reads back as the same request.
#include <plugins/common/open_options.h>

#include <fuzz/spelling.h>
#include <fuzz/temporary_file.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const osio::fuzz::TemporaryFile file(bytes, count);
    const auto open = osio::plugin::read_recipe(file.path());
    if (open)
        osio::fuzz::check_spelling(open->request);
    return 0;
}
