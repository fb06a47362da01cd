// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/spectra/basis.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// A standard observer: three colour-matching functions at 1 nm, 360-830 nm.
struct Observer {
    std::string id;                     ///< "cie1931"
    std::string source;                 ///< standard and edition
    std::string sha256;                 ///< of the table's bytes
    std::array<NmSamples, 3> curves{};  ///< x, y, z
};

/// The observer of that name (case ignored): cie1931, cie1964. UnknownName names the nearest.
[[nodiscard]] Result<Observer> find_observer(std::string_view name);

/// Every name that find_observer knows.
[[nodiscard]] std::vector<std::string> observer_names();

}  // namespace osio
