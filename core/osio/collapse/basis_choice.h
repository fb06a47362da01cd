// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/request.h>
#include <osio/layout/channel_layout.h>
#include <osio/layout/spectral_metadata.h>
#include <osio/spectra/band_integrals.h>

#include <optional>
#include <string>
#include <vector>

namespace osio {

/// The distinct wavelengths of a set as the curves that a basis needs, and to which of them each band
/// belongs.
struct DistinctBands {
    BandGrid grid;
    std::vector<std::size_t> index_of_band;
    std::vector<std::size_t> bands_at;  ///< how many bands share a wavelength

    /// The share of its wavelength's weight that a band has: a collapse takes the mean of bands that
    /// share one.
    [[nodiscard]] double share_of(std::size_t band) const {
        return 1 / static_cast<double>(bands_at[index_of_band[band]]);
    }
};

/// Bands that share a wavelength are one; of several responses at it the first counts. Edges and
/// responses are taken over where the metadata has them for every band.
[[nodiscard]] DistinctBands distinct_bands(const SpectralSet& set, const SpectralMetadata& metadata);

/// A basis, why it was chosen, and what a user should know of the choice.
struct BasisChoice {
    Basis basis = Basis::Linear;
    std::string reason;
    std::optional<std::string> warning;
    bool stated = false;  ///< by the request or the file, rather than taken for likely
};

/// True where a basis other than Auto can be used on a grid as it is, without falling back to Linear.
[[nodiscard]] bool basis_fits(Basis basis, const BandGrid& grid);

/// The fewest bands for which Auto corrects bins. From here on the mean error over 33 lights is smaller, and
/// under continuous light about half or less; with fewer, lines make the slopes that neighbours tell wrong as
/// often as right (docs/accuracy.md).
inline constexpr std::size_t kFewestCorrectedBins = 8;

/// Decides the basis of a request.
///
/// Auto obeys the attribute `spectral:basis`; else takes Response where every band has a sensitivity or
/// a width of its own; Bins where the file states edges; Linear for bands 1 nm apart or closer on
/// average; else a reflectance for samples (Sprague on equal steps, E2022 on 3 to 5, Linear
/// otherwise) and a radiance, which cameras and renderers average, for bins (BinsCorrected on
/// kFewestCorrectedBins equal steps or more, Bins otherwise).
///
/// A basis that needs more bands than there are, and an interpolation of bands closer than 1 nm, become
/// Linear, with a warning. InvalidGrid where the request names a basis that the bands cannot have:
/// Sprague or BinsCorrected on unequal steps, Response without responses.
[[nodiscard]] Result<BasisChoice> choose_basis(Basis requested, const SpectralSet& set, const BandGrid& grid,
                                               const SpectralMetadata& metadata);

}  // namespace osio
