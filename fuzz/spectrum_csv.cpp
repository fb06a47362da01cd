// SPDX-License-Identifier: Apache-2.0
//
// A table is refused or is a curve of positive, increasing wavelengths.
#include <osio/spectra/spectrum.h>

#include <cmath>
#include <fuzz/target.h>
#include <string_view>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const auto curve = osio::parse_spectrum_csv({reinterpret_cast<const char*>(bytes), count});
    if (!curve)
        return 0;
    osio::fuzz::require(!curve->values.empty() && curve->wavelengths_nm.size() == curve->values.size());
    double before = 0;
    for (std::size_t i = 0; i < curve->values.size(); ++i) {
        osio::fuzz::require(std::isfinite(curve->values[i]) && curve->wavelengths_nm[i] > before);
        before = curve->wavelengths_nm[i];
    }
    return 0;
}
