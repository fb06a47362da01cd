// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/audit.h>
#include <tools/osiotool/json_text.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/report_explain.h>

#include <osio/base/text.h>
#include <osio/collapse/basis_spread.h>

namespace osio::tool {

namespace {

Json window_json(const image::Window& w) {
    return {w.min_x, w.min_y, w.max_x, w.max_y};
}

Json optional_text(const std::optional<std::string>& text) {
    return text ? Json(*text) : Json(nullptr);
}

/// A text, or null where it is empty.
Json named_text(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json set_json(const image::Part& part, const SpectralSet& set) {
    Json channels = Json::array(), types = Json::array();
    for (const Band& band : set.bands) {
        channels.push_back(part.layout.channel_names[band.channel]);
        types.push_back(sample_type_name(part.channels[band.channel].type));
    }
    Json out{{"name", set.name()},
             {"bands", set.bands.size()},
             {"quantity", quantity_name(set.quantity())},
             {"wavelengths_nm", set.wavelengths_nm()},
             {"spacing", spacing_text(set.wavelengths_nm())},
             {"channels", std::move(channels)},
             {"types", std::move(types)},
             {"reradiation", set.reradiation.size()}};
    out["units"] =
        set.quantity() == Quantity::Radiance ? optional_text(part.metadata.emissive_units) : Json(nullptr);
    return out;
}

Json part_json(const image::Part& part) {
    Json sets = Json::array(), others = Json::array(), warnings = Json::array();
    for (const SpectralSet& set : part.layout.sets)
        sets.push_back(set_json(part, set));
    for (const std::size_t channel : part.layout.others)
        others.push_back({{"name", part.layout.channel_names[channel]},
                          {"type", sample_type_name(part.channels[channel].type)}});
    for (const auto* list : {&part.layout.warnings, &part.metadata.warnings})
        for (const std::string& warning : *list)
            warnings.push_back(warning);
    return {{"name", part.name},
            {"width", part.data_window.width()},
            {"height", part.data_window.height()},
            {"data_window", window_json(part.data_window)},
            {"display_window", window_json(part.display_window)},
            {"storage", !part.storage.empty() ? part.storage
                        : part.tiled          ? "tiles"
                                              : "scanlines"},
            {"deep", part.deep},
            {"compression", part.compression},
            {"channels", part.channels.size()},
            {"dialect", named_text(part.layout.dialect.name)},
            {"dialect_evidence", named_text(part.layout.dialect.evidence)},
            {"layout_version", optional_text(part.metadata.layout_version)},
            {"sets", std::move(sets)},
            {"other_channels", std::move(others)},
            {"warnings", std::move(warnings)}};
}

/// What is done to the weights' sums, by the name of its result.
std::string curve_name(const OutputSpace& space) {
    if (space.transform)
        return "ocio";
    if (!is_tristimulus(space.kind))
        return space.id;
    return space.transfer == Transfer::Srgb ? "srgb" : "linear";
}

Json spread_json(const CollapsePlan& plan) {
    Json out = Json::object();
    for (const BasisSpread& spread : basis_spread(plan))
        out[std::string(basis_name(spread.basis))] = {{"mean", spread.residual.mean},
                                                      {"max", spread.residual.max}};
    return out;
}

/// The colour config's share of a plan, or null.
Json config_json(const OutputSpace& space) {
    if (!space.transform)
        return nullptr;
    const TransformSource& source = space.transform->source();
    return {{"config", source.config_file},  {"config_name", source.config_name},
            {"config_id", source.config_id}, {"from", source.from},
            {"processor", source.processor}, {"linear", space.transform->is_linear()}};
}

/// The pairs of a fluorescent set, or null.
Json reradiation_json(const CollapsePlan& plan) {
    if (!plan.reradiation)
        return nullptr;
    Json pairs = Json::array();
    for (const PlanColumn& column : plan.columns)
        if (column.emitted_nm)
            pairs.push_back({column.wavelength_nm, *column.emitted_nm});
    return {{"pairs_nm", std::move(pairs)}, {"unlit_share", plan.reradiation->unlit_share}};
}

Json plan_object(const image::CollapseJob& job) {
    const CollapsePlan& plan = job.plan;
    Json weights = Json::array(), channels = Json::array();
    for (std::size_t row = 0; row < plan.weights.rows(); ++row) {
        const auto values = plan.weights.row(row);
        weights.push_back(std::vector<double>(values.begin(), values.end()));
    }
    for (const PlanColumn& column : plan.columns)
        channels.push_back(job.part().layout.channel_names[column.channel]);
    Json filters = Json::array();
    for (const Filter& filter : plan.filters)
        filters.push_back(filter.path);
    const bool reflectance = plan.illuminant.has_value();
    return {{"file", job.file->path()},
            {"part", job.part_index},
            {"set", plan.request.set},
            {"quantity", reflectance ? "reflectance" : "radiance"},
            {"to", plan.space.id},
            {"color_space", plan.space.color_space.empty() ? Json(nullptr) : Json(plan.space.color_space)},
            {"curve", curve_name(plan.space)},
            {"ocio", config_json(plan.space)},
            {"observer", plan.observer.id},
            {"observer_source", plan.observer.source},
            {"illuminant", reflectance ? Json(plan.illuminant->id) : Json(nullptr)},
            {"illuminant_source", reflectance ? Json(plan.illuminant->source) : Json(nullptr)},
            {"filters", std::move(filters)},
            {"display", plan.display ? Json(plan.display->path) : Json(nullptr)},
            {"basis", basis_name(plan.basis.basis)},
            {"basis_reason", plan.basis.reason},
            {"basis_spread", spread_json(plan)},
            {"quadrature", plan.quadrature == Quadrature::Sum1nm ? "sum1nm" : "exact"},
            {"extrapolate", extrapolation_name(plan.request.extrapolation)},
            {"scale", scale_name(plan.request.scale)},
            {"exposure", plan.request.exposure_stops},
            {"white", plan.white},
            {"adapt",
             is_adapted(plan.space.kind) ? Json(adaptation_name(plan.request.adaptation)) : Json(nullptr)},
            {"adapted_from", plan.adapted_from ? Json(*plan.adapted_from) : Json(nullptr)},
            {"outputs", plan.outputs},
            {"weighed", plan.weighed()},
            {"channel_names", job.channel_names()},
            {"wavelengths_nm", plan.wavelengths_nm()},
            {"channels", std::move(channels)},
            {"reradiation", reradiation_json(plan)},
            {"weights", std::move(weights)},
            {"extrapolated_share", plan.extrapolated_share},
            {"recipe", recipe_text(plan.request)},
            {"id", plan.id},
            {"warnings", job.warnings}};
}

Json rows_json(const std::vector<exr::BadRows>& bad) {
    Json out = Json::array();
    for (const exr::BadRows& run : bad)
        out.push_back({run.rows.first, run.rows.last});
    return out;
}

Json soundness_json(const FileSoundness& file) {
    Json parts = Json::array();
    for (std::size_t index = 0; index < file.parts.size(); ++index) {
        const exr::PartSoundness& part = file.parts[index];
        parts.push_back({{"name", file.file->parts()[index].name},
                         {"sound", part.decoded ? Json(part.sound()) : Json(nullptr)},
                         {"decoded", part.decoded},
                         {"not_decoded", part.not_decoded},
                         {"bad_rows", rows_json(part.bad)},
                         {"reason", part.sound() ? Json(nullptr) : Json(part.bad.front().why)}});
    }
    return {{"file", file.path},
            {"sound", !file.damaged() && !file.failure},
            {"checksum", file.checksum()},
            {"failure", file.failure ? Json(file.failure->what) : Json(nullptr)},
            {"parts", std::move(parts)}};
}

Json outcome_object(const image::CollapseJob& job, const CollapseOutcome& outcome) {
    return {{"input", job.file->path()},
            {"output", outcome.output},
            {"type", outcome.type},
            {"width", job.part().data_window.width()},
            {"height", job.part().data_window.height()},
            {"channel_names", job.channel_names()},
            {"pixels", outcome.counts.pixels},
            {"nan_pixels", outcome.counts.nan},
            {"infinite_pixels", outcome.counts.infinite},
            {"negative_pixels", outcome.counts.negative},
            {"undefined_pixels", outcome.counts.polarisation.undefined},
            {"overpolarised_pixels", outcome.counts.polarisation.beyond},
            {"clipped_pixels", outcome.clipped_pixels},
            {"clamped_samples", outcome.clamped_samples},
            {"missing_rows", rows_json(outcome.missing)},
            {"seconds", outcome.seconds},
            {"recipe", recipe_text(job.plan.request)},
            {"id", job.plan.id},
            {"warnings", job.warnings}};
}

Json audited_json(const AuditedPart& part) {
    Json sets = Json::array(), quirks = Json::array();
    for (const AuditedSet& set : part.sets)
        sets.push_back({{"name", set.name},
                        {"quantity", quantity_name(set.quantity)},
                        {"bands", set.wavelengths_nm.size()},
                        {"basis", basis_name(set.basis.basis)},
                        {"basis_reason", set.basis.reason}});
    for (const Quirk& quirk : part.quirks)
        quirks.push_back({{"what", quirk.what}, {"done", quirk.done}});
    return {{"name", part.name},
            {"writer", named_text(part.writer.name)},
            {"writer_evidence", named_text(part.writer.evidence)},
            {"dialect", named_text(part.dialect.name)},
            {"dialect_evidence", named_text(part.dialect.evidence)},
            {"sets", std::move(sets)},
            {"assumed", part.assumed},
            {"quirks", std::move(quirks)},
            {"problems", part.problems}};
}

}  // namespace

std::string spaces_json(const ColourConfig* config) {
    Json spaces = Json::array(), names = Json::array();
    for (const OutputSpace& space : output_spaces()) {
        Json aliases = Json::array();
        for (const std::string_view alias : split(space.aliases, '|'))
            if (!alias.empty())
                aliases.push_back(alias);
        spaces.push_back(
            {{"name", space.id},
             {"color_space", space.color_space.empty() ? Json(nullptr) : Json(space.color_space)},
             {"aliases", std::move(aliases)}});
    }
    if (config == nullptr)
        return dump({{"spaces", std::move(spaces)}, {"config", nullptr}});
    for (const ConfigName& entry : config->names())
        names.push_back({{"name", entry.name}, {"kind", entry.kind}, {"aliases", entry.aliases}});
    return dump(
        {{"spaces", std::move(spaces)},
         {"config", {{"file", config->file()}, {"name", config->name()}, {"names", std::move(names)}}}});
}

std::string convert_json(const ConvertReport& report) {
    const convert::Outcome& outcome = report.outcome;
    return dump({{"input", report.input},
                 {"output", outcome.output},
                 {"outputs", outcome.outputs},
                 {"data", outcome.data.empty() ? Json(nullptr) : Json(outcome.data)},
                 {"width", outcome.width},
                 {"height", outcome.height},
                 {"bands", outcome.bands},
                 {"types", outcome.types},
                 {"lost", outcome.lost},
                 {"clamped_samples", outcome.clamped_samples},
                 {"clipped_samples", outcome.clipped_samples},
                 {"seconds", report.seconds},
                 {"warnings", outcome.warnings}});
}

std::string frames_json(const std::vector<FrameReport>& reports) {
    Json frames = Json::array();
    for (const FrameReport& report : reports)
        frames.push_back({{"frame", report.frame},
                          {"exit_code", report.code},
                          {"error", report.error.empty() ? Json(nullptr) : Json(report.error)},
                          {"report", report.json.empty() ? Json(nullptr) : Json::parse(report.json)}});
    return dump({{"frames", std::move(frames)}});
}

std::string info_json(const image::SpectralImage& file) {
    Json parts = Json::array();
    for (const image::Part& part : file.parts())
        parts.push_back(part_json(part));
    return dump({{"file", file.path()}, {"format", file.format()}, {"parts", std::move(parts)}});
}

std::string audit_json(const std::vector<AuditedFile>& files) {
    Json out = Json::array();
    for (const AuditedFile& file : files) {
        Json parts = Json::array();
        for (const AuditedPart& part : file.parts)
            parts.push_back(audited_json(part));
        out.push_back({{"file", file.path},
                       {"format", named_text(file.format)},
                       {"failure", file.failure ? Json(file.failure->what) : Json(nullptr)},
                       {"parts", std::move(parts)}});
    }
    return dump({{"files", std::move(out)}});
}

std::string plans_json(const std::vector<image::CollapseJob>& jobs, const std::vector<Explained>& explained) {
    Json plans = Json::array();
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        plans.push_back(plan_object(jobs[i]));
        if (!explained.empty())
            plans.back()["explain"] = explain_object(jobs[i], explained[i]);
    }
    return dump(jobs.size() == 1 ? plans.front() : Json{{"plans", std::move(plans)}});
}

std::string verify_json(const std::vector<FileSoundness>& files) {
    Json out = Json::array();
    for (const FileSoundness& file : files)
        out.push_back(soundness_json(file));
    return dump({{"files", std::move(out)}});
}

std::string outcomes_json(const std::vector<image::CollapseJob>& jobs,
                          const std::vector<CollapseOutcome>& outcomes) {
    Json outputs = Json::array();
    for (std::size_t i = 0; i < jobs.size(); ++i)
        outputs.push_back(outcome_object(jobs[i], outcomes[i]));
    return dump(jobs.size() == 1 ? outputs.front() : Json{{"outputs", std::move(outputs)}});
}

}  // namespace osio::tool
