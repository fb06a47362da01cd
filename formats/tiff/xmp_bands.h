// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace osio::tiff {

/// What the XMP packet of a multispectral camera says of its one band.
struct XmpBand {
    double wavelength_nm = 0;  ///< 0 where it does not say
    double fwhm_nm = 0;
    std::string name;
};

/// Reads `Camera:CentralWavelength`, `Camera:WavelengthFWHM` and `Camera:BandName`, as attributes or elements of any
/// rdf:Description; nm. All of it is 0 and empty where the packet is no XML or says nothing.
[[nodiscard]] XmpBand read_xmp_band(const std::string& packet);

}  // namespace osio::tiff
