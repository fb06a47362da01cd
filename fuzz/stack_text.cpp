// SPDX-License-Identifier: Apache-2.0
//
// Any text as a list of band files: refused, or files with names and lengths that are ones.
#include <formats/image/limits.h>
#include <formats/stack/stack_text.h>

#include <fuzz/target.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const auto stack = osio::stack::parse_stack({reinterpret_cast<const char*>(bytes), count});
    if (!stack)
        return 0;
    osio::fuzz::require(!stack->files.empty() && stack->files.size() <= osio::image::kMostChannels);
    osio::fuzz::require(!stack->scale || *stack->scale > 0);
    for (const auto& file : stack->files)
        osio::fuzz::require(!file.path.empty() && file.wavelength_nm >= 0 && file.fwhm_nm >= 0);
    return 0;
}
