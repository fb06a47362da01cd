// SPDX-License-Identifier: Apache-2.0
//
// Writes a spectral OpenEXR of the ColorChecker: 24 measured reflectances at 5 nm, and below them two
// greys that look alike under D65 and only there.
//
//     colorchecker OUT.exr [PIXELS_PER_PATCH]

#include <formats/exr/exr_writer.h>
#include <formats/exr/spectral_header.h>

#include <osio/base/text.h>
#include <osio/colour/illuminant.h>
#include <osio/data/tables.h>
#include <osio/layout/channel_layout.h>
#include <osio/spectra/band_integrals.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using namespace osio;

constexpr std::size_t kColumns = 6;
constexpr std::size_t kRows = 4;
constexpr std::size_t kGrey = 21;  // neutral 5: the grey that gets a twin

/// Weights of the bands for X, Y and Z under D65, as a collapse takes samples at equal steps.
std::array<std::vector<double>, 3> xyz_weights(const Table& table) {
    const NmSamples light = find_illuminant("D65")->power;
    const Observer observer = find_observer("cie1931").value();
    const BandGrid grid{{table.wavelengths_nm.begin(), table.wavelengths_nm.end()}, {}, {}};
    std::array<std::vector<double>, 3> out;
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = band_integrals(Basis::Sprague, grid, light, observer.curves[c], Extrapolation::Hold,
                                Quadrature::Sum1nm);
    return out;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// A metamer: a wave is added whose part that D65 and the observer see has been taken out.
std::vector<double> metamer(const Table& table, const std::vector<double>& reflectance) {
    const auto w = xyz_weights(table);
    std::vector<double> wave;
    for (const double nm : table.wavelengths_nm)
        wave.push_back(std::sin(nm / 18));
    Matrix3 gram;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            gram.rows[r][c] = dot(w[r], w[c]);
    const Vector3 share = inverse(gram) * Vector3{dot(w[0], wave), dot(w[1], wave), dot(w[2], wave)};
    for (std::size_t i = 0; i < wave.size(); ++i)
        wave[i] -= share[0] * w[0][i] + share[1] * w[1][i] + share[2] * w[2][i];
    // As large as a reflectance between 0.02 and 0.98 allows.
    double scale = 1;
    for (std::size_t i = 0; i < wave.size(); ++i)
        scale = std::min(scale,
                         (wave[i] > 0 ? 0.98 - reflectance[i] : reflectance[i] - 0.02) / std::abs(wave[i]));
    std::vector<double> out = reflectance;
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] += scale * wave[i];
    return out;
}

Result<void> write(const std::string& path, std::size_t patch) {
    const Table& table = *find_table("reflectances/colorchecker_n_ohta.csv");
    std::vector<std::vector<double>> reflectances;
    for (const std::string_view name : table.columns)
        reflectances.push_back(table.column(name)->values);
    const std::vector<double> twin = metamer(table, reflectances[kGrey]);

    const std::size_t gap = patch / 10, cell = patch + gap;
    const std::size_t width = kColumns * cell + gap, height = (kRows + 1) * cell + gap;
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.insert("comments", Imf::StringAttribute("ColorChecker reflectances of N. Ohta; below, a "
                                                   "measured grey and its metamer under D65"));
    std::vector<std::string> names;
    for (const double nm : table.wavelengths_nm)
        names.push_back(format_channel_name({"", Family::T, nm, {}}, DecimalMark::Comma));
    exr::complete_spectral_header(parse_channel_layout(names, DecimalMark::Comma), header);
    std::vector<exr::OutputChannel> channels;
    for (const std::string& name : names)
        channels.push_back({name});
    OSIO_TRY(const auto writer, exr::ExrWriter::create(path, header, channels));

    std::vector<float> row(width * channels.size());
    for (std::size_t y = 0; y < height; ++y) {
        std::fill(row.begin(), row.end(), 0.03F);  // the frame between the patches
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t column = x / cell, line = y / cell;
            if (column >= kColumns || line > kRows || x % cell < gap || y % cell < gap)
                continue;
            const auto& left = line < kRows ? reflectances[line * kColumns + column] : reflectances[kGrey];
            const auto& spectrum = line == kRows && column >= kColumns / 2 ? twin : left;
            for (std::size_t band = 0; band < channels.size(); ++band)
                row[band * width + x] = static_cast<float>(spectrum[band]);
        }
        std::vector<exr::ChannelRows> rows;
        for (std::size_t band = 0; band < channels.size(); ++band)
            rows.push_back({reinterpret_cast<const std::byte*>(&row[band * width]), sizeof(float),
                            static_cast<std::ptrdiff_t>(width * sizeof(float))});
        OSIO_CHECK_OK(writer->write_rows(1, rows));
    }
    return writer->finish();
}

}  // namespace

int main(int argc, char** argv) {
    const auto patch = argc > 2 ? parse_int(argv[2]) : std::optional(90);
    if (argc < 2 || argc > 3 || !patch || *patch < 10 || *patch > 1000) {
        std::fprintf(stderr, "usage: colorchecker OUT.exr [PIXELS_PER_PATCH, 10 to 1000]\n");
        return 2;
    }
    const auto result = write(argv[1], static_cast<std::size_t>(*patch));
    if (!result)
        std::fprintf(stderr, "colorchecker: %s\n", result.error().text().c_str());
    return result ? 0 : 1;
}
