// SPDX-License-Identifier: Apache-2.0
#include <osio/base/fingerprint.h>
#include <osio/base/text.h>
#include <osio/collapse/stokes_plan.h>
#include <osio/colour/polarisation.h>

#include <algorithm>
#include <array>

namespace osio {

namespace {

constexpr std::array<Family, 4> kComponents{Family::S0, Family::S1, Family::S2, Family::S3};

const SpectralSet* find_set(std::span<const SpectralSet> sets, const std::string& root, Family family) {
    const auto found = std::find_if(sets.begin(), sets.end(), [&](const SpectralSet& set) {
        return set.root == root && set.family == family;
    });
    return found == sets.end() ? nullptr : &*found;
}

std::string names_of(std::span<const SpectralSet> sets) {
    std::vector<std::string> names;
    for (const SpectralSet& set : sets)
        names.push_back(set.name());
    return join(names, ", ");
}

/// The sets that the space is made of.
Result<std::vector<const SpectralSet*>> components_of(std::span<const SpectralSet> sets,
                                                      const std::string& root, SpaceKind kind) {
    std::vector<const SpectralSet*> out;
    std::vector<std::string> missing;
    for (const std::size_t index : stokes_components(kind)) {
        out.push_back(find_set(sets, root, kComponents[index]));
        if (out.back() == nullptr)
            missing.push_back((root.empty() ? std::string() : root + ".") +
                              std::string(family_name(kComponents[index])));
    }
    if (!missing.empty())
        return fail(ErrorCode::NoSuchPart, "there is no set " + join(missing, ", ") +
                                               ", which to=" + to_lower(space_outputs(kind).front()) +
                                               " is made of; found " + names_of(sets));
    return out;
}

std::string id_of(const CollapsePlan& plan, const std::vector<std::string>& parts) {
    Fingerprint id;
    id.add(recipe_text(plan.request));
    for (const std::string& part : parts)
        id.add(part);
    for (const PlanColumn& column : plan.columns)
        id.add(column.wavelength_nm);
    return id.hex();
}

}  // namespace

Result<CollapsePlan> make_stokes_plan(std::span<const SpectralSet> sets, std::size_t chosen, SpaceKind kind,
                                      const MakeSetPlan& make) {
    const SpectralSet& named = sets[chosen];
    if (named.quantity() == Quantity::Reflectance)
        return fail(ErrorCode::Usage, "set " + named.name() +
                                          " is a reflectance, which has no Stokes "
                                          "components; name S0, S1, S2 or S3");
    OSIO_TRY(const auto components, components_of(sets, named.root, kind));
    const SpectralSet* intensity = find_set(sets, named.root, Family::S0);
    const SpectralSet& carrier = intensity != nullptr ? *intensity : *components.front();
    OSIO_TRY(const CollapsePlan carried, make(carrier));

    std::vector<CollapsePlan> plans;
    std::vector<std::string> ids;
    std::vector<std::string> strangers;
    std::size_t columns = 0;
    for (const SpectralSet* set : components) {
        if (set->wavelengths_nm() == carrier.wavelengths_nm()) {
            plans.push_back(carried);
        } else {
            OSIO_TRY(CollapsePlan own, make(*set));
            plans.push_back(std::move(own));
            strangers.push_back(set->name());
        }
        ids.push_back(plans.back().id);
        columns += set->bands.size();
    }

    CollapsePlan out = plans.front();
    out.request.set = components.front()->name();
    out.bands = components.front()->bands;
    out.columns.clear();
    out.extrapolated_share.clear();
    out.weights = WeightMatrix(components.size(), columns);
    for (std::size_t row = 0; row < components.size(); ++row) {
        const std::size_t first = out.columns.size();
        for (std::size_t band = 0; band < components[row]->bands.size(); ++band) {
            out.columns.push_back({components[row]->bands[band].channel,
                                   components[row]->bands[band].wavelength_nm, std::nullopt});
            out.weights.at(row, first + band) = plans[row].weights.at(0, band);
        }
        out.extrapolated_share.push_back(plans[row].extrapolated_share.front());
    }
    if (!strangers.empty())
        out.warnings.push_back("the bands of " + join(strangers, ", ") + " are not at the wavelengths of " +
                               carrier.name() + ": each component is integrated over its own");
    out.id = id_of(out, ids);
    return out;
}

}  // namespace osio
