// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/resampling.h>
#include <osio/spectra/bin_basis.h>
#include <osio/spectra/interpolation_basis.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

constexpr double kMostWavelengths = 65536;
/// Steps are decimals: places are rounded to millionths of a nanometre, which are their nearest doubles again.
constexpr double kPlacesPerNm = 1e6;

std::string range_text(const std::vector<double>& nm) {
    return format_double(nm.front()) + "-" + format_double(nm.back()) + " nm";
}

tl::unexpected<Error> no_grid(std::string_view text, const std::string& expected) {
    return fail(ErrorCode::Usage, "found \"" + std::string(text) + "\", expected " + expected);
}

/// What lies beyond the bands, in words.
std::optional<std::string> beyond(const std::vector<double>& targets, const BandGrid& grid,
                                  Extrapolation extrapolation) {
    const auto count = std::count_if(targets.begin(), targets.end(), [&](double nm) {
        return nm < grid.wavelengths_nm.front() || nm > grid.wavelengths_nm.back();
    });
    if (count == 0)
        return std::nullopt;
    return std::to_string(count) + " of " + std::to_string(targets.size()) + " new bands lie beyond " +
           range_text(grid.wavelengths_nm) +
           (extrapolation == Extrapolation::Hold ? ": they hold the value of the end band"
                                                 : ": they are zero");
}

/// The distinct wavelengths' weights at one new wavelength.
std::vector<double> row_of(Basis basis, const BandGrid& grid, double nm, double step_nm,
                           Extrapolation extrapolation) {
    if (!is_binned(basis))
        return interpolation_weights(basis, grid.wavelengths_nm, nm, extrapolation);
    return bin_average_weights(grid.edges(), nm - step_nm / 2, nm + step_nm / 2,
                               basis == Basis::BinsCorrected, extrapolation);
}

}  // namespace

std::vector<double> WavelengthGrid::wavelengths_nm() const {
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(std::round((first_nm + static_cast<double>(i) * step_nm) * kPlacesPerNm) /
                      kPlacesPerNm);
    return out;
}

Result<WavelengthGrid> parse_wavelength_grid(std::string_view text) {
    const auto pieces = split(text, ':');
    std::vector<double> numbers;
    for (const std::string_view piece : pieces)
        if (const auto number = parse_double(trim(piece)))
            numbers.push_back(*number);
    if (pieces.size() != 3 || numbers.size() != 3)
        return no_grid(text, "first:step:last in nm, such as 400:10:700");
    const double first = numbers[0], step = numbers[1], last = numbers[2];
    if (!(first > 0 && step > 0 && last >= first) || !std::isfinite(last))
        return no_grid(text,
                       "wavelengths above 0 nm, a step above 0, and a last one that is not below the first");
    const double count = std::floor((last - first) / step + 1 / kPlacesPerNm) + 1;
    if (!(count <= kMostWavelengths))
        return no_grid(text, "at most " + format_double(kMostWavelengths) + " wavelengths");
    return WavelengthGrid{first, step, static_cast<std::size_t>(count)};
}

Result<ResamplingPlan> plan_resampling(const SpectralSet& set, const SpectralMetadata& metadata,
                                       const Resampling& resampling) {
    if (resampling.basis == Basis::Response)
        return fail(ErrorCode::InvalidGrid,
                    "basis=response is for collapsing; resampling takes linear, sprague, e2022, bins or "
                    "bins-corrected");
    DistinctBands distinct = distinct_bands(set, metadata);
    BandGrid& grid = distinct.grid;
    const std::vector<double> targets = resampling.grid.wavelengths_nm();
    const double step = resampling.grid.step_nm;
    const auto& edges = grid.edges();
    if (targets.back() + step / 2 < edges.front() || targets.front() - step / 2 > edges.back())
        return fail(ErrorCode::Unsupported, "the new bands " + range_text(targets) + " and those of set " +
                                                set.name() + ", " + range_text(grid.wavelengths_nm) +
                                                ", have nothing in common");
    ResamplingPlan out;
    SpectralMetadata said = metadata;
    if (!grid.responses.empty() && resampling.basis == Basis::Auto)
        out.warnings.emplace_back("the bands' own responses are not used for resampling");
    grid.responses.clear();
    if (said.basis == std::string(basis_name(Basis::Response)))
        said.basis.reset();
    OSIO_TRY(out.basis, choose_basis(resampling.basis, set, grid, said));
    if (out.basis.warning)
        out.warnings.push_back(*out.basis.warning);
    if (auto warning = beyond(targets, grid, resampling.extrapolation))
        out.warnings.push_back(std::move(*warning));
    out.binned = is_binned(out.basis.basis);
    out.identity = targets == grid.wavelengths_nm && grid.size() == set.bands.size();
    out.weights = WeightMatrix(targets.size(), set.bands.size());
    for (std::size_t t = 0; t < targets.size(); ++t) {
        std::vector<double> row(grid.size(), 0.0);
        if (out.identity)
            row[t] = 1;
        else
            row = row_of(out.basis.basis, grid, targets[t], step, resampling.extrapolation);
        for (std::size_t band = 0; band < set.bands.size(); ++band)
            out.weights.at(t, band) = row[distinct.index_of_band[band]] * distinct.share_of(band);
    }
    return out;
}

}  // namespace osio
