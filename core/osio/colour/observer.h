// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/spectra/basis.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// What an observer's numbers are.
enum class ObserverKind {
    Colorimetric,  ///< X, Y, Z
    Luminous,      ///< one luminous efficiency, in curves[1]; the others are zero
    Camera,        ///< a camera's own R, G, B
};

/// Who looks: up to three curves at 1 nm, 360-830 nm.
struct Observer {
    std::string id;      ///< "cie1931", or the path of the user's table
    std::string source;  ///< standard and edition, or the user's table
    std::string digest;  ///< of the curves: names the numbers that were used
    ObserverKind kind = ObserverKind::Colorimetric;
    std::array<NmSamples, 3> curves{};  ///< x, y, z; red, green, blue
};

/// The observer of that name (case ignored). Colorimetric: cie1931, cie1964, cie2015_2deg,
/// cie2015_10deg (zero below the 390 nm where CIE 170-2 starts). Luminous: photopic (V, CIE 1924: the
/// y-bar of cie1931), scotopic (V', CIE 1951). UnknownName names the nearest.
[[nodiscard]] Result<Observer> find_observer(std::string_view name);

/// A camera from a user's table `nm,R,G,B` of relative sensitivities (see parse_curves_csv): straight
/// lines at 1 nm, zero outside it. Usage where a channel sees nothing of 360-830 nm. Sensitivities
/// slightly below zero, which measured tables hold, are kept.
[[nodiscard]] Result<Observer> camera_from_csv(std::string_view csv, std::string_view path);

/// Every name that find_observer knows.
[[nodiscard]] std::vector<std::string> observer_names();

}  // namespace osio
