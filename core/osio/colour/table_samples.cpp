// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/colour/table_samples.h>

#include <algorithm>

namespace osio {

NmSamples sampled_at_1nm(const Spectrum& spectrum) {
    NmSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = spectrum.linear_at(kObserverFirstNm + static_cast<double>(i));
    return out;
}

NmSamples sampled_at_1nm_held(const Spectrum& spectrum) {
    NmSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = spectrum.held_at(kObserverFirstNm + static_cast<double>(i));
    return out;
}

std::string digest_of(const NmSamples& samples) {
    Fingerprint fingerprint;
    for (const double s : samples)
        fingerprint.add(s);
    return fingerprint.hex();
}

Result<void> check_not_black(const NmSamples& samples, const Spectrum& spectrum, std::string_view quantity,
                             std::string_view path) {
    if (std::any_of(samples.begin(), samples.end(), [](double s) { return s != 0; }))
        return {};
    return fail(ErrorCode::Usage,
                "no " + std::string(quantity) + " at any whole nanometre of 360-830 nm (the table covers " +
                    format_double(spectrum.wavelengths_nm.front()) + "-" +
                    format_double(spectrum.wavelengths_nm.back()) + " nm)",
                std::string(path));
}

}  // namespace osio
