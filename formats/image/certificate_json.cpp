// SPDX-License-Identifier: Apache-2.0
#include <formats/image/certificate.h>

#include <osio/base/text.h>

#include <nlohmann/json.hpp>

#include <limits>

namespace osio::image {

namespace {

using Json = nlohmann::ordered_json;

std::string_view depth_name(StoredDepth depth) {
    switch (depth) {
    case StoredDepth::Float: return "float";
    case StoredDepth::Half: return "half";
    case StoredDepth::Uint8: return "uint8";
    case StoredDepth::Uint16: break;
    }
    return "uint16";
}

Json bound_json(const ErrorBound& bound) {
    return {{"delta_e_2000", bound.delta_e_2000}, {"xyz", bound.xyz}};
}

Json terms_json(const BudgetResult& budget) {
    Json out = Json::array();
    for (const ErrorSource source : kErrorSources) {
        Json term{{"name", error_source_name(source)}};
        term.update(bound_json(budget.term(source)));
        term["how"] = error_source_method(source);
        out.push_back(std::move(term));
    }
    return out;
}

/// The tables that took part. The name of a table that is a file is its path.
Json tables_json(const CollapsePlan& plan) {
    Json out = Json::array();
    const auto add = [&out](std::string_view role, const std::string& name, const std::string& source,
                            const std::string& digest) {
        out.push_back({{"role", role}, {"name", name}, {"source", source}, {"digest", digest}});
    };
    add("observer", plan.observer.id, plan.observer.source, plan.observer.digest);
    if (plan.illuminant)
        add("illuminant", plan.illuminant->id, plan.illuminant->source, plan.illuminant->digest);
    for (const Filter& filter : plan.filters)
        add("filter", filter.path, filter.path, filter.digest);
    if (plan.display)
        add("display", plan.display->path, plan.display->path, plan.display->digest);
    return out;
}

}  // namespace

std::string certificate_json(const CollapseJob& job, const Certificate& certificate, bool one_line) {
    const CollapsePlan& plan = job.plan;
    const BudgetResult& budget = certificate.budget;
    Json proved{{"total", bound_json(budget.total)}, {"terms", terms_json(budget)}};
    Json not_proved{{"distance", "to the colour of the continuous spectrum"},
                    {"indicator", budget.indicator},
                    {"indicator_over", certificate.indicator_over},
                    {"total_with_indicator", budget.with_indicator},
                    {"alternatives", certificate.alternatives},
                    {"assumption", certificate.assumption}};
    const Json out{{"certificate", 1},
                   {"input", job.file->path()},
                   {"part", job.part_index},
                   {"set", plan.request.set},
                   {"output", certificate.output.empty() ? Json(nullptr) : Json(certificate.output)},
                   {"type", depth_name(certificate.depth)},
                   {"recipe", recipe_text(plan.request)},
                   {"plan", plan.id},
                   {"basis", basis_name(plan.basis.basis)},
                   {"basis_reason", plan.basis.reason},
                   {"white_luminance", certificate.white_luminance},
                   {"white_luminance_from", certificate.white_reason},
                   {"pixels", budget.pixels},
                   {"undefined_pixels", budget.undefined},
                   {"nan_pixels", certificate.counts.nan},
                   {"infinite_pixels", certificate.counts.infinite},
                   {"negative_pixels", certificate.counts.negative},
                   {"clamped_pixels", budget.clamped},
                   {"proved", std::move(proved)},
                   {"not_proved", std::move(not_proved)},
                   {"max_delta_e", certificate.max_delta_e ? Json(*certificate.max_delta_e) : Json(nullptr)},
                   {"beyond_pixels", budget.beyond},
                   {"holds", certificate.holds()},
                   {"tables", tables_json(plan)}};
    // Text from files may hold bytes that are no UTF-8; they are replaced rather than refused.
    return out.dump(one_line ? -1 : 2, ' ', false, Json::error_handler_t::replace) + (one_line ? "" : "\n");
}

std::size_t most_certificate_bytes(const CollapseJob& job) {
    // Every number at its longest, every basis an alternative, and a name of a file as long as a system takes.
    constexpr double kLong = -std::numeric_limits<double>::max();
    constexpr std::size_t kLongestPath = 4096;
    Certificate certificate;
    certificate.output.assign(kLongestPath, 'x');
    certificate.depth = StoredDepth::Uint16;
    const ErrorBound longest{{kLong, kLong, kLong}, kLong};
    BudgetResult& budget = certificate.budget;
    budget.terms.fill(longest);
    budget.total = longest;
    budget.indicator = budget.with_indicator = kLong;
    constexpr auto kMany = std::numeric_limits<std::uint64_t>::max();
    budget.pixels = budget.undefined = budget.clamped = budget.beyond = kMany;
    certificate.counts = {kMany, kMany, kMany, kMany};
    certificate.white_luminance = kLong;
    certificate.white_reason.assign(64, 'x');
    certificate.indicator_over.assign(64, 'x');
    for (const BasisInfo& info : bases())
        certificate.alternatives.emplace_back(info.name);
    certificate.assumption.assign(512 + 2 * job.plan.basis.reason.size(), 'x');
    certificate.max_delta_e = kLong;
    return certificate_json(job, certificate, true).size();
}

}  // namespace osio::image
