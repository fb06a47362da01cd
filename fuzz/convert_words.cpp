// SPDX-License-Identifier: Apache-2.0
//
// Whatever words a conversion is given, what is read from them is frames, wavelengths or a range.
#include <formats/convert/convert.h>
#include <formats/files/sequence.h>

#include <fuzz/target.h>
#include <set>
#include <string>
#include <string_view>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), count);
    if (const auto frames = osio::files::parse_frames(text)) {
        osio::fuzz::require(!frames->empty());
        osio::fuzz::require(std::set<int>(frames->begin(), frames->end()).size() == frames->size());
    }
    const std::string name = osio::files::frame_name(text, -7);
    osio::fuzz::require(osio::files::has_frame_place(text) || name == text);
    if (const auto grid = osio::parse_wavelength_grid(text))
        osio::fuzz::require(grid->count > 0 && grid->count <= 65536 && grid->step_nm > 0 &&
                            grid->first_nm > 0);
    if (const auto range = osio::convert::parse_range(text))
        osio::fuzz::require(range->first_nm < range->last_nm);
    return 0;
}
