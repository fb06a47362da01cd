// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/colour/table_samples.h>
#include <osio/spectra/basis.h>

#include <string>
#include <string_view>

namespace osio {

/// A gel, glass or lens: transmittance at 1 nm, 360-830 nm, 0 to 1.
struct Filter {
    std::string path;
    std::string digest;  ///< names the numbers that were used
    NmSamples transmittance{};
    UltravioletSamples ultraviolet{};    ///< transmittance there
    double first_nm = kObserverFirstNm;  ///< where its table begins; end values count beyond it
    double last_nm = kObserverLastNm;    ///< where its table ends
};

/// A filter from a user's table (see parse_spectrum_csv): straight lines at 1 nm, end values held beyond
/// the table. Usage where a transmittance is below 0 or above 1 (a table in per cent, say).
[[nodiscard]] Result<Filter> filter_from_csv(std::string_view csv, std::string_view path);

}  // namespace osio
