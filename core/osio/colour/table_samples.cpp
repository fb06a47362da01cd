// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/colour/table_samples.h>

#include <algorithm>

namespace osio {

namespace {

/// value_at at every nanometre from `first_nm` on.
template <class Samples, class ValueAt>
Samples sampled(int first_nm, ValueAt value_at) {
    Samples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = value_at(first_nm + static_cast<double>(i));
    return out;
}

}  // namespace

NmSamples sampled_at_1nm(const Spectrum& spectrum) {
    return sampled<NmSamples>(kObserverFirstNm, [&](double nm) { return spectrum.linear_at(nm); });
}

NmSamples sampled_at_1nm_held(const Spectrum& spectrum) {
    return sampled<NmSamples>(kObserverFirstNm, [&](double nm) { return spectrum.held_at(nm); });
}

UltravioletSamples ultraviolet_at_1nm(const Spectrum& spectrum) {
    return sampled<UltravioletSamples>(kUltravioletFirstNm,
                                       [&](double nm) { return spectrum.linear_at(nm); });
}

UltravioletSamples ultraviolet_at_1nm_held(const Spectrum& spectrum) {
    return sampled<UltravioletSamples>(kUltravioletFirstNm, [&](double nm) { return spectrum.held_at(nm); });
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
