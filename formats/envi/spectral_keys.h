// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_header.h>

namespace osio::envi {

/// Fills in what the fields say of the bands: wavelengths, widths, bad bands, and what the numbers mean. The
/// sizes are known already. Errors and warnings are those of parse_header().
[[nodiscard]] Result<void> read_spectral_keys(EnviHeader& header, const OpenWords& words);

/// The numbers of a list with one item a band; empty where the header has no such key.
[[nodiscard]] Result<std::vector<double>> numbers_by_band(const EnviHeader& header, std::string_view key);

}  // namespace osio::envi
