// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/basis_choice.h>
#include <osio/colour/table_samples.h>
#include <osio/spectra/response_basis.h>

#include <algorithm>
#include <numeric>

namespace osio {

namespace {

/// A response that can be averaged with: it sees something of 360-830 nm.
std::optional<NmSamples> usable(const NmSamples& response) {
    const double sum = std::accumulate(response.begin(), response.end(), 0.0);
    return sum > 0 ? std::optional(response) : std::nullopt;
}

std::optional<NmSamples> response_of(const Band& band, const SpectralMetadata& metadata) {
    if (const auto found = metadata.sensitivities.find(band.channel); found != metadata.sensitivities.end())
        return found->second.values.empty() ? std::nullopt : usable(sampled_at_1nm(found->second));
    if (!metadata.fwhm)
        return std::nullopt;
    const double width_nm = metadata.fwhm->held_at(band.wavelength_nm);
    return width_nm > 0 ? usable(gaussian_response(band.wavelength_nm, width_nm)) : std::nullopt;
}

std::string count_of(const BandGrid& grid) {
    return std::to_string(grid.size()) + (grid.size() == 1 ? " band" : " bands");
}

std::string quoted(Basis basis) {
    return "basis=" + std::string(basis_name(basis));
}

bool interpolates(Basis basis) {
    return basis == Basis::Sprague || basis == Basis::E2022;
}

/// The same choice, as one that somebody stated.
BasisChoice stated(BasisChoice choice) {
    choice.stated = true;
    return choice;
}

/// The basis as asked for, or Linear where the bands are too few or too close, aloud.
BasisChoice fitted(Basis basis, std::string reason, const BandGrid& grid) {
    const std::size_t fewest = fewest_bands(basis);
    if (grid.size() < fewest)
        return {Basis::Linear, std::move(reason),
                quoted(basis) + " needs " + std::to_string(fewest) + " bands and there are " +
                    std::to_string(grid.size()) + ": straight lines are used"};
    if (interpolates(basis) && quadrature_for(grid.wavelengths_nm) == Quadrature::Exact)
        return {Basis::Linear, std::move(reason),
                quoted(basis) + " is a sum at 1 nm and there are bands closer than that: straight lines are "
                                "integrated exactly"};
    return {basis, std::move(reason), std::nullopt};
}

Result<void> check_fits(Basis basis, const BandGrid& grid) {
    const bool needs_equal_steps = basis == Basis::Sprague || basis == Basis::BinsCorrected;
    if (needs_equal_steps && grid.size() >= fewest_bands(basis) &&
        (!grid.uniform() || !grid.edges_nm.empty()))
        return fail(ErrorCode::InvalidGrid,
                    quoted(basis) + " needs bands at equal steps, and these are not; use " +
                        quoted(basis == Basis::Sprague ? Basis::Linear : Basis::Bins));
    if (basis == Basis::Response && grid.responses.empty())
        return fail(ErrorCode::InvalidGrid,
                    "basis=response needs a sensitivity of every band (an attribute named like its channel) "
                    "or widths (spectral:fwhm), and this file does not have them; use basis=auto");
    return {};
}

BasisChoice suggested(const SpectralSet& set, const BandGrid& grid) {
    if (!grid.responses.empty())
        return stated(fitted(Basis::Response, "every band states its own response", grid));
    const std::string steps = grid.uniform() ? " at equal steps" : " at unequal steps";
    if (!grid.edges_nm.empty())
        return stated({Basis::Bins, "the file states the edges of its bins", std::nullopt});
    if (grid.size() > 1 && grid.mean_step_nm() <= 1)
        return {Basis::Linear, "bands 1 nm apart or closer are the samples that CIE 15 sums", std::nullopt};
    if (set.quantity() == Quantity::Radiance) {
        const bool corrected = grid.uniform() && grid.size() >= kFewestCorrectedBins;
        return {corrected ? Basis::BinsCorrected : Basis::Bins,
                "radiance counts as bin averages, as cameras and renderers record it; " + count_of(grid) +
                    steps,
                std::nullopt};
    }
    const std::string reason = "reflectance counts as samples, as it is measured; " + count_of(grid) + steps;
    if (!grid.uniform() || grid.size() < fewest_bands(Basis::E2022))
        return {Basis::Linear, reason, std::nullopt};
    return {grid.size() >= fewest_bands(Basis::Sprague) ? Basis::Sprague : Basis::E2022, reason,
            std::nullopt};
}

}  // namespace

bool basis_fits(Basis basis, const BandGrid& grid) {
    return basis != Basis::Auto && check_fits(basis, grid) && !fitted(basis, {}, grid).warning;
}

DistinctBands distinct_bands(const SpectralSet& set, const SpectralMetadata& metadata) {
    DistinctBands out;
    BandGrid& grid = out.grid;
    for (const Band& band : set.bands) {
        if (grid.wavelengths_nm.empty() || grid.wavelengths_nm.back() != band.wavelength_nm) {
            grid.wavelengths_nm.push_back(band.wavelength_nm);
            out.bands_at.push_back(0);
            if (auto response = response_of(band, metadata))
                grid.responses.push_back(*response);
        }
        ++out.bands_at.back();
        out.index_of_band.push_back(grid.size() - 1);
    }
    if (grid.responses.size() != grid.size())
        grid.responses.clear();
    if (metadata.bin_edges_nm.size() == grid.size() + 1)
        grid.edges_nm = metadata.bin_edges_nm;
    return out;
}

Result<BasisChoice> choose_basis(Basis requested, const SpectralSet& set, const BandGrid& grid,
                                 const SpectralMetadata& metadata) {
    if (requested != Basis::Auto) {
        OSIO_CHECK_OK(check_fits(requested, grid));
        return stated(fitted(requested, "as requested", grid));
    }
    if (metadata.basis) {
        const auto named = find_basis(*metadata.basis);
        if (named && *named != Basis::Auto && check_fits(*named, grid))
            return stated(fitted(*named, "the file states spectral:basis \"" + *metadata.basis + "\"", grid));
        BasisChoice choice = suggested(set, grid);
        choice.warning = "spectral:basis is \"" + *metadata.basis + "\", which " +
                         (named ? "these bands cannot have" : "is unknown") + ": " +
                         std::string(basis_name(choice.basis)) + " is used";
        return choice;
    }
    return suggested(set, grid);
}

}  // namespace osio
