// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/spectra/basis.h>

#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// Reflectances that a matrix is fitted to, at 1 nm, 360-830 nm; their ends are held.
struct ReflectanceSet {
    std::string id;      ///< "colorchecker", or the path of the user's table
    std::string source;  ///< publication, or the user's table
    std::string digest;  ///< names the numbers that were used
    std::vector<NmSamples> spectra;
};

/// "colorchecker": the 24 patches of N. Ohta's measurement. UnknownName says so.
[[nodiscard]] Result<ReflectanceSet> find_reflectance_set(std::string_view name);

/// A user's table: nm and one column for each reflectance. Usage as of parse_curves_csv.
[[nodiscard]] Result<ReflectanceSet> reflectance_set_from_csv(std::string_view csv, std::string_view path);

}  // namespace osio
