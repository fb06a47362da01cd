// SPDX-License-Identifier: Apache-2.0
//
// Any text as GDAL's metadata: refused, or items that come back from their own text.
#include <formats/tiff/gdal_metadata.h>
#include <formats/tiff/page_bands.h>
#include <formats/tiff/xmp_bands.h>

#include <fuzz/target.h>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const std::string text(reinterpret_cast<const char*>(bytes), count);
    const auto camera = osio::tiff::read_xmp_band(text);
    osio::fuzz::require(camera.wavelength_nm >= 0 && camera.fwhm_nm >= 0);
    const auto items = osio::tiff::parse_gdal_metadata(text);
    if (!items)
        return 0;
    osio::fuzz::require(osio::tiff::parse_gdal_metadata(osio::tiff::gdal_metadata_text(*items)).has_value());
    osio::tiff::Page page;
    page.samples = 3;
    page.gdal_metadata = text;
    const auto bands = osio::tiff::read_bands(page);
    if (!bands)
        return 0;
    osio::fuzz::require(bands->facts.size() == 3 && bands->scaling.size() == 3);
    for (const auto& facts : bands->facts)
        osio::fuzz::require(facts.wavelength_nm >= 0 && facts.wavelength_nm < 1e301 && facts.fwhm_nm >= 0);
    return 0;
}
