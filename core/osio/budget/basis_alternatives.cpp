// SPDX-License-Identifier: Apache-2.0
#include <osio/budget/basis_alternatives.h>

namespace osio {

bool is_alternative(const CollapsePlan& plan, Basis basis) {
    const Basis own = plan.basis.basis;
    return basis != own && basis_fits(basis, plan.distinct.grid) &&
           (!plan.basis.stated || is_binned(basis) == is_binned(own));
}

std::vector<CollapsePlan> basis_alternatives(const CollapsePlan& plan, const SpectralSet& set,
                                             const SpectralMetadata& metadata, const TextLoader& load_text) {
    std::vector<CollapsePlan> out;
    for (const BasisInfo& info : bases()) {
        if (!is_alternative(plan, info.basis))
            continue;
        CollapseRequest request = plan.request;
        request.basis = info.basis;
        // A basis that fits the bands may still not have weights under this light; then it says nothing.
        if (auto other = make_plan(set, metadata, request, load_text))
            out.push_back(std::move(*other));
    }
    return out;
}

std::string alternatives_assumption(const CollapsePlan& plan) {
    const std::string kind = is_binned(plan.basis.basis) ? "averages over bins" : "samples";
    return plan.basis.stated ? "the bands are " + kind + " (" + plan.basis.reason +
                                   "), and the spectrum between them is as smooth as the bases assume: a "
                                   "line or edge narrower "
                                   "than the bands may lie farther away than all of them"
                             : "the bands are samples or averages over bins (" + plan.basis.reason +
                                   "; nobody states it), and the spectrum between them is as smooth as the "
                                   "bases assume: a line "
                                   "or edge narrower than the bands may lie farther away than all of them";
}

}  // namespace osio
