// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>

#include <cstddef>
#include <span>

namespace osio {

/// Makes the plan of one set, whatever its space.
using MakeSetPlan = std::function<Result<CollapsePlan>(const SpectralSet& set)>;

/// The plan for a polarimetric space: a row of weights for each component that the space needs, all of y-bar
/// or the request's luminous curve, over the columns of all of these sets. `sets` are those of one part and
/// `chosen` is one of them, which says whose root is meant.
///
/// S1, S2 and S3 get the weights of S0, whose sensitivities and widths the file states, where their bands are
/// at its wavelengths; else weights of their own, with a warning. Usage for a reflectance, NoSuchPart where a
/// component is missing.
[[nodiscard]] Result<CollapsePlan> make_stokes_plan(std::span<const SpectralSet> sets, std::size_t chosen,
                                                    SpaceKind kind, const MakeSetPlan& make);

}  // namespace osio
