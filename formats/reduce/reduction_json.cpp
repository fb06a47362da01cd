// SPDX-License-Identifier: Apache-2.0
#include <formats/reduce/reduction.h>

#include <nlohmann/json.hpp>

#include <limits>

namespace osio::reduce {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kIndent = 2;

constexpr std::string_view kWarning = "proved for the demands named here and no others; under lights of "
                                      "not_for the colours are known to be off by more";

Json json_of(const Reduction& reduction) {
    Json demands = Json::array(), others = Json::array();
    for (const DemandResult& demand : reduction.demands)
        demands.push_back({{"light", demand.light},
                           {"observer", demand.observer},
                           {"original_plan", demand.original_plan},
                           {"reduced_plan", demand.reduced_plan},
                           {"delta_e_max", demand.largest},
                           {"delta_e_mean", demand.mean},
                           {"largest_at", demand.largest_at},
                           {"undefined_pixels", demand.undefined}});
    for (const OtherResult& other : reduction.others)
        others.push_back(
            {{"light", other.light}, {"observer", other.observer}, {"delta_e_max", other.largest}});
    return {{"max_delta_e", reduction.tolerance},
            {"demands", std::move(demands)},
            {"pixels", reduction.pixels},
            {"white_luminance", reduction.white_luminance},
            {"white_luminance_from", reduction.white_reason},
            {"source", reduction.source},
            {"source_bytes", reduction.source_bytes},
            {"source_bands", reduction.source_bands},
            {"source_samples", reduction.source_samples},
            {"set", reduction.set},
            {"bands", reduction.wavelengths_nm.size()},
            {"wavelengths_nm", reduction.wavelengths_nm},
            {"edges_nm", reduction.edges_nm},
            {"coefficients", reduction.coefficients},
            {"basis", reduction.basis},
            {"samples", reduction.samples},
            {"compression", reduction.compression},
            {"fidelity", reduction.fidelity},
            {"changed_pixels", reduction.changed_pixels},
            {"negative_samples", reduction.negative_samples},
            {"clamped_samples", reduction.clamped_samples},
            {"sampled_pixels", reduction.sampled_pixels},
            {"spectrum_rms", reduction.spectrum_rms},
            {"spectrum_max", reduction.spectrum_largest},
            {"not_for", reduction.not_for()},
            {"others", std::move(others)},
            {"lost", reduction.lost},
            {"warning", kWarning}};
}

/// Names and paths of the user's may hold bytes that are no UTF-8; they are replaced.
std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string reduction_json(const Reduction& reduction, bool one_line) {
    return text_of(json_of(reduction), one_line ? -1 : kIndent);
}

std::string outcome_json(const Outcome& outcome, double seconds) {
    Json out{{"output", outcome.output},    {"bytes", outcome.bytes},   {"width", outcome.width},
             {"height", outcome.height},    {"passes", outcome.passes}, {"seconds", seconds},
             {"warnings", outcome.warnings}};
    out.update(json_of(outcome.reduction));
    return text_of(out, kIndent) + "\n";
}

std::size_t most_reduction_bytes(const Reduction& reduction) {
    // The longest that a pass can set: numbers of 17 digits with sign and exponent, counts of 20.
    constexpr double kLong = -2.2250738585072014e-308;
    constexpr auto kMany = std::numeric_limits<std::uint64_t>::max();
    Reduction longest = reduction;
    longest.pixels = longest.changed_pixels = longest.negative_samples = longest.clamped_samples = kMany;
    for (DemandResult& demand : longest.demands) {
        demand.largest = demand.mean = kLong;
        demand.largest_at = {std::numeric_limits<int>::min(), std::numeric_limits<int>::min()};
        demand.undefined = kMany;
    }
    return reduction_json(longest, true).size();
}

}  // namespace osio::reduce
