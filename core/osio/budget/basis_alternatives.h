// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>

#include <string>
#include <vector>

namespace osio {

/// True for a basis other than the plan's that its bands may stand for: any that they can have; where the
/// request or the file states what they are, samples or averages over bins, one of that kind.
[[nodiscard]] bool is_alternative(const CollapsePlan& plan, Basis basis);

/// The same request with every basis that is_alternative(): what the same samples would be if they stood for
/// other curves.
[[nodiscard]] std::vector<CollapsePlan> basis_alternatives(const CollapsePlan& plan, const SpectralSet& set,
                                                           const SpectralMetadata& metadata,
                                                           const TextLoader& load_text);

/// What the distance to the alternatives says, and what it does not.
[[nodiscard]] std::string alternatives_assumption(const CollapsePlan& plan);

}  // namespace osio
