// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>
#include <osio/colour/difference.h>

#include <vector>

namespace osio {

/// How far another basis would be from the one of a plan.
struct BasisSpread {
    Basis basis = Basis::Linear;
    DifferenceSummary residual;  ///< CIEDE2000 over the patches
};

/// The spread between the bases that a plan's bands can have, over the 24 patches of the ColorChecker
/// (data/reflectances): if the bands are what the plan takes them for (samples, or averages of bins),
/// this is what another basis would make of the same numbers. A reflectance is seen under the plan's
/// light and filters, a radiance is that of the patches under D65. The white of Lab is the plan's.
///
/// In the order of bases(), without the plan's own; empty where the observer has no colour space
/// (photopic, scotopic, cameras) or the white has no Z.
[[nodiscard]] std::vector<BasisSpread> basis_spread(const CollapsePlan& plan);

}  // namespace osio
