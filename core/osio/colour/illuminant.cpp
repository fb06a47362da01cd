// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/colour/illuminant.h>
#include <osio/data/tables.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osio {

namespace {

constexpr std::string_view kTable = "illuminants/cie_1nm.csv";

/// Below this share of luminous power in a light (an ultraviolet lamp, say) 1/Y is noise: the
/// smallest value of a CIE y-bar between 360 and 830 nm is 4.5e-7.
constexpr double kSmallestLuminousShare = 1e-9;

NmSamples sampled_at_1nm(const Spectrum& spectrum) {
    NmSamples out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = spectrum.linear_at(kObserverFirstNm + static_cast<double>(i));
    return out;
}

std::string digest_of(const NmSamples& power) {
    Fingerprint fingerprint;
    for (const double p : power)
        fingerprint.add(p);
    return fingerprint.hex();
}

/// CIE 15 calls the fluorescent lamps FL1...; F1... is the older name.
std::string canonical(std::string_view name) {
    const std::string lower = to_lower(name);
    const bool old_name = lower.size() > 1 && lower[0] == 'f' && lower[1] >= '0' && lower[1] <= '9';
    return old_name ? "fl" + lower.substr(1) : lower;
}

}  // namespace

Result<Illuminant> find_illuminant(std::string_view name) {
    const Table& table = *find_table(kTable);
    const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                     [&](std::string_view c) { return to_lower(c) == canonical(name); });
    if (column == table.columns.end())
        return fail(ErrorCode::UnknownName,
                    "no illuminant is called \"" + std::string(name) + "\"" +
                        suggestion(name, illuminant_names()) +
                        " (a table of your own is named by its path and ends in .csv)");
    const auto index = static_cast<std::size_t>(column - table.columns.begin());
    Illuminant out{
        std::string(*column), std::string(table.sources[index]), {}, sampled_at_1nm(*table.column(*column))};
    out.digest = digest_of(out.power);
    return out;
}

Result<Illuminant> illuminant_from_csv(std::string_view csv, std::string_view path) {
    auto spectrum = parse_spectrum_csv(csv);
    if (!spectrum)
        return fail_within(path, spectrum.error());
    for (std::size_t i = 0; i < spectrum->values.size(); ++i)
        if (spectrum->values[i] < 0)
            return fail(ErrorCode::Usage,
                        "the power " + format_double(spectrum->values[i]) + " at " +
                            format_double(spectrum->wavelengths_nm[i]) +
                            " nm is negative; a light has none below zero",
                        std::string(path));
    Illuminant out{std::string(path), "table " + std::string(path), {}, sampled_at_1nm(*spectrum)};
    if (std::all_of(out.power.begin(), out.power.end(), [](double p) { return p == 0; }))
        return fail(ErrorCode::Usage,
                    "no power at any whole nanometre of 360-830 nm (the table covers " +
                        format_double(spectrum->wavelengths_nm.front()) + "-" +
                        format_double(spectrum->wavelengths_nm.back()) + " nm)",
                    std::string(path));
    out.digest = digest_of(out.power);
    return out;
}

std::vector<std::string> illuminant_names() {
    const Table& table = *find_table(kTable);
    return {table.columns.begin(), table.columns.end()};
}

Result<Vector3> white_point(const Illuminant& light, const Observer& observer, Quadrature quadrature) {
    Vector3 xyz{};
    for (std::size_t c = 0; c < 3; ++c)
        xyz[c] = integral(light.power, observer.curves[c], quadrature);
    const double power = std::accumulate(light.power.begin(), light.power.end(), 0.0);
    if (!(xyz[1] > kSmallestLuminousShare * power))
        return fail(ErrorCode::InvalidGrid,
                    "the light has no luminance (sum of S y-bar is " + format_double(xyz[1]) +
                        "), so no white can be normalised to Y = 1",
                    light.id);
    return Vector3{xyz[0] / xyz[1], 1.0, xyz[2] / xyz[1]};
}

}  // namespace osio
