// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/basis_choice.h>
#include <osio/collapse/weights.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Bands at other wavelengths: a linear map from the values of a set to those of another grid.
namespace osio {

/// Equally spaced wavelengths in nm.
struct WavelengthGrid {
    double first_nm = 0;
    double step_nm = 0;
    std::size_t count = 0;

    /// Decimals of the text come back as themselves: 400.3, not 400.30000000000001.
    [[nodiscard]] std::vector<double> wavelengths_nm() const;
};

/// Reads `first:step:last` in nm, as `400:10:700`; the grid ends at or before `last`. Usage where it is no such
/// text, the step is not above 0, the last is below the first, or there are more than 65536 wavelengths.
[[nodiscard]] Result<WavelengthGrid> parse_wavelength_grid(std::string_view text);

/// What to make of bands.
struct Resampling {
    WavelengthGrid grid;
    Basis basis = Basis::Auto;
    Extrapolation extrapolation = Extrapolation::Hold;
};

/// One row for each new wavelength, one column for each band of the set. A row that is one band alone, and
/// nothing else, has the weight 1 exactly.
struct ResamplingPlan {
    WeightMatrix weights;
    BasisChoice basis;
    bool identity = false;  ///< the new wavelengths are the set's own
    bool binned = false;    ///< the new bands are averages over [nm - step / 2, nm + step / 2]
    std::vector<std::string> warnings;
};

/// Plans a resampling. Linear, Sprague and E2022 take the curve's value at each new wavelength; Bins and
/// BinsCorrected its average over each new bin, a step wide. Auto chooses as choose_basis() does, but without
/// responses, which say what a band saw and not what lies between bands. Bands that share a wavelength count as
/// their mean. Where the new wavelengths are the set's own, the weights are the identity.
///
/// Refuses as choose_basis() does, Response (InvalidGrid), and a grid that no band is near (Unsupported: the
/// ranges do not touch).
[[nodiscard]] Result<ResamplingPlan> plan_resampling(const SpectralSet& set, const SpectralMetadata& metadata,
                                                     const Resampling& resampling);

}  // namespace osio
