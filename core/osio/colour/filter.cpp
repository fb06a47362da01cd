// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/colour/filter.h>
#include <osio/colour/table_samples.h>
#include <osio/spectra/spectrum.h>

namespace osio {

Result<Filter> filter_from_csv(std::string_view csv, std::string_view path) {
    const auto spectrum = parse_spectrum_csv(csv);
    if (!spectrum)
        return fail_within(path, spectrum.error());
    for (std::size_t i = 0; i < spectrum->values.size(); ++i) {
        const double value = spectrum->values[i];
        if (value < 0 || value > 1)
            return fail(ErrorCode::Usage,
                        "the transmittance " + format_double(value) + " at " +
                            format_double(spectrum->wavelengths_nm[i]) +
                            " nm is not between 0 and 1; divide a table in per cent by 100",
                        std::string(path));
    }
    Filter out{std::string(path),
               {},
               sampled_at_1nm_held(*spectrum),
               ultraviolet_at_1nm_held(*spectrum),
               spectrum->wavelengths_nm.front(),
               spectrum->wavelengths_nm.back()};
    out.digest = digest_of(out.transmittance);
    return out;
}

}  // namespace osio
