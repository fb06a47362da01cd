// SPDX-License-Identifier: Apache-2.0
//
// Any text as an ENVI header: refused, or its lists fit its bands and its size cannot overflow.
#include <formats/envi/envi_header.h>
#include <formats/image/limits.h>

#include <fuzz/target.h>
#include <string_view>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const auto header = osio::envi::parse_header({reinterpret_cast<const char*>(bytes), count});
    if (!header)
        return 0;
    const auto fits = [&header](std::size_t items) { return items == 0 || items == header->bands; };
    osio::fuzz::require(fits(header->wavelengths_nm.size()) && fits(header->fwhm_nm.size()) &&
                        fits(header->bad.size()) && fits(header->gain.size()) && fits(header->offset.size()));
    osio::fuzz::require(header->data_size() / header->bands / header->lines / header->samples ==
                        osio::envi::data_bytes(header->type));
    osio::fuzz::require(header->data_size() <= osio::image::kMostPartBytes);
    for (const double nm : header->wavelengths_nm)
        osio::fuzz::require(nm >= 0 && nm < 1e301);
    return 0;
}
