// SPDX-License-Identifier: Apache-2.0
//
// Whatever an attribute holds, what is read from it is a curve.
#include <osio/spectra/spectrum.h>

#include <cmath>
#include <fuzz/target.h>
#include <string_view>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    const auto read = osio::parse_spectrum_text({reinterpret_cast<const char*>(bytes), count});
    const auto& curve = read.spectrum;
    osio::fuzz::require(curve.wavelengths_nm.size() == curve.values.size());
    for (std::size_t i = 0; i < curve.values.size(); ++i)
        osio::fuzz::require(std::isfinite(curve.values[i]) && std::isfinite(curve.wavelengths_nm[i]) &&
                            (i == 0 || curve.wavelengths_nm[i - 1] < curve.wavelengths_nm[i]));
    return 0;
}
