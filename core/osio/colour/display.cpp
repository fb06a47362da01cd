// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/colour/display.h>
#include <osio/colour/table_samples.h>

namespace osio {

Spectrum Display::spectrum_of(const Vector3& rgb) const {
    Spectrum out{emission[0].wavelengths_nm, std::vector<double>(emission[0].values.size(), 0.0)};
    for (std::size_t c = 0; c < rgb.size(); ++c)
        for (std::size_t i = 0; i < out.values.size(); ++i)
            out.values[i] += rgb[c] * emission[c].values[i];
    return out;
}

Matrix3 Display::xyz_from_rgb(const Observer& observer) const {
    Matrix3 out;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t c = 0; c < 3; ++c)
            out.rows[row][c] = integral(emission_nm[c], observer.curves[row], Quadrature::Sum1nm);
    const double white_y = out.rows[1][0] + out.rows[1][1] + out.rows[1][2];
    for (Vector3& row : out.rows)
        for (double& value : row)
            value /= white_y;
    return out;
}

Result<Display> display_from_csv(std::string_view csv, std::string_view path) {
    constexpr std::array<std::string_view, 3> kPrimaries{"red emission", "green emission", "blue emission"};
    auto curves = parse_curves_csv(csv, kPrimaries.size());
    if (!curves)
        return fail_within(path, curves.error());
    Display out{std::string(path), {}, {}, {}};
    Fingerprint digest;
    for (std::size_t c = 0; c < kPrimaries.size(); ++c) {
        out.emission[c] = std::move((*curves)[c]);
        out.emission_nm[c] = sampled_at_1nm(out.emission[c]);
        OSIO_CHECK_OK(check_not_black(out.emission_nm[c], out.emission[c], kPrimaries[c], path));
        digest.add(digest_of(out.emission_nm[c]));
    }
    out.digest = digest.hex();
    return out;
}

}  // namespace osio
