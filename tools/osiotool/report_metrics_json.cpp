// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/json_text.h>
#include <tools/osiotool/report.h>

namespace osio::tool {

std::string difference_json(const DifferenceOutcome& outcome) {
    const ValueStatistics& delta = outcome.counts.delta_e;
    Json warnings = Json::array();
    for (const image::ColourImage* image : {&outcome.a, &outcome.b})
        for (const std::string& warning : image->warnings)
            warnings.push_back(image->file->path() + ": " + warning);
    return dump({{"a", outcome.a.file->path()},
                 {"b", outcome.b.file->path()},
                 {"a_meaning", outcome.a.meaning},
                 {"b_meaning", outcome.b.meaning},
                 {"pixels", delta.count() + delta.undefined_count()},
                 {"undefined_pixels", delta.undefined_count()},
                 {"mean", delta.mean()},
                 {"percentile_95", delta.percentile(95)},
                 {"percentile_99", delta.percentile(99)},
                 {"max", delta.maximum()},
                 {"max_pixel", outcome.counts.largest_at},
                 {"failing_pixels", outcome.counts.beyond_fail},
                 {"warning_pixels", outcome.counts.beyond_warn},
                 {"verdict", outcome.verdict.empty() ? Json(nullptr) : Json(outcome.verdict)},
                 {"warnings", std::move(warnings)}});
}

std::string photometry_json(const PhotometryOutcome& outcome) {
    const ValueStatistics& l = outcome.luminance;
    return dump(
        {{"input", outcome.input},
         {"set", outcome.set},
         {"pixels", l.count() + l.undefined_count()},
         {"undefined_pixels", l.undefined_count()},
         {"luminance_mean", l.mean()},
         {"luminance_min", l.minimum()},
         {"luminance_max", l.maximum()},
         {"luminance_percentiles",
          {{"1", l.percentile(1)},
           {"5", l.percentile(5)},
           {"50", l.percentile(50)},
           {"95", l.percentile(95)},
           {"99", l.percentile(99)}}},
         {"scotopic_mean", outcome.scotopic_mean},
         {"sp_ratio", l.mean() != 0 ? Json(outcome.scotopic_mean / l.mean()) : Json(nullptr)},
         {"radiance_mean", outcome.radiance_mean},
         {"efficacy", outcome.radiance_mean != 0 ? Json(l.mean() / outcome.radiance_mean) : Json(nullptr)},
         {"warnings", outcome.warnings}});
}

std::string light_json(const LightOutcome& outcome) {
    const auto& t = outcome.temperature;
    return dump({{"illuminant", outcome.light.id},
                 {"illuminant_source", outcome.light.source},
                 {"efficacy", outcome.photometry.efficacy()},
                 {"scotopic_efficacy", outcome.photometry.scotopic_efficacy()},
                 {"sp_ratio", outcome.photometry.sp_ratio()},
                 {"xy", {outcome.xy.x, outcome.xy.y}},
                 {"cct", t ? Json(t->cct_k) : Json(nullptr)},
                 {"duv", t ? Json(t->duv) : Json(nullptr)}});
}

std::string bake_json(const BakedMatrix& baked, const std::string& output) {
    Json tables = Json::array();
    for (const UsedTable& table : baked.tables)
        tables.push_back(
            {{"role", table.role}, {"name", table.name}, {"source", table.source}, {"digest", table.digest}});
    const auto& residual = baked.residual;
    return dump({{"output", output},
                 {"title", baked.title},
                 {"matrix", baked.matrix.rows},
                 {"fitted_spectra", baked.fitted_spectra},
                 {"residual_mean", residual ? Json(residual->mean) : Json(nullptr)},
                 {"residual_max", residual ? Json(residual->max) : Json(nullptr)},
                 {"tables", std::move(tables)}});
}

}  // namespace osio::tool
