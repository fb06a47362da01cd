// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report_explain.h>
#include <tools/osiotool/text_table.h>

#include <fmt/format.h>

#include <optional>

namespace osio::tool {

namespace {

constexpr double kMega = 1e6;

/// The step's share of a forecast; nothing for what has no time of its own.
std::optional<double> seconds_of(const std::string& step, const trade::Times& times) {
    if (step == "read")
        return times.open + times.decode;
    if (step == "sum")
        return times.collapse;
    if (step == "write")
        return times.write;
    return std::nullopt;
}

std::vector<std::string> zero_channels(const image::CollapseJob& job, const Explained& explained) {
    std::vector<std::string> out;
    for (const std::size_t column : explained.forecast.zero_columns)
        out.push_back(job.part().channels[job.plan.columns[column].channel].name);
    return out;
}

std::string what_of(const image::Step& step, const image::Explanation& explanation) {
    if (step.name == "read")
        return fmt::format("{}, {:.1f} MB unpacked", step.what,
                           static_cast<double>(explanation.sample_bytes) / kMega);
    if (step.name == "sum")
        return fmt::format("{}, {:.1f} million products", step.what,
                           static_cast<double>(explanation.products) / kMega);
    return step.what;
}

}  // namespace

std::string explain_text(const image::CollapseJob& job, const Explained& explained) {
    const trade::Forecast& forecast = explained.forecast.forecast;
    std::string out = fmt::format("recipe  {}\nplan    {}\n", recipe_text(job.plan.request), job.plan.id);
    out += fmt::format("image   {}: {}x{} pixels\n\n", job.file->path(), job.part().data_window.width(),
                       job.part().data_window.height());
    TextTable steps({{"step"}, {"predicted s", TextTable::Align::Right}, {"what"}});
    for (const image::Step& step : explained.explanation.steps) {
        const auto seconds = seconds_of(step.name, forecast.times);
        steps.add({step.name,
                   step.identity ? "nothing"
                   : seconds     ? fmt::format("{:.3f}", *seconds)
                                 : "in the sum",
                   what_of(step, explained.explanation)});
    }
    steps.add(
        {"all", fmt::format("{:.3f}", forecast.times.total()),
         fmt::format("on {} worker{}, into an EXR of floats, as {} of {} rows took it", explained.workers,
                     explained.workers == 1 ? "" : "s", forecast.rows_run, forecast.rows)});
    out += steps.text();

    TextTable left({{"left out"}, {"since"}});
    for (const image::LeftOut& item : explained.explanation.left_out)
        left.add({item.what, item.why});
    if (const auto zero = zero_channels(job, explained); !zero.empty())
        left.add({fmt::format("{} of the channels that are read, {} to {}", zero.size(), zero.front(),
                              zero.back()),
                  fmt::format("zero in all {} rows looked at; blocks of zeros are not summed",
                              forecast.rows_run)});
    out += left.empty() ? "\nnothing is left out\n" : "\n" + left.text();
    for (const std::string& warning : job.warnings)
        out += "warning: " + warning + "\n";
    return out;
}

Json explain_object(const image::CollapseJob& job, const Explained& explained) {
    const image::Explanation& explanation = explained.explanation;
    const trade::Forecast& forecast = explained.forecast.forecast;
    Json steps = Json::array(), left_out = Json::array();
    for (const image::Step& step : explanation.steps) {
        const auto seconds = seconds_of(step.name, forecast.times);
        steps.push_back({{"step", step.name},
                         {"what", step.what},
                         {"identity", step.identity},
                         {"predicted", seconds ? Json(*seconds) : Json(nullptr)}});
    }
    for (const image::LeftOut& item : explanation.left_out)
        left_out.push_back({{"what", item.what}, {"why", item.why}});
    return {{"pixels", explanation.pixels},
            {"samples", explanation.samples},
            {"sample_bytes", explanation.sample_bytes},
            {"products", explanation.products},
            {"predicted", forecast.times.total()},
            {"predicted_from_rows", forecast.rows_run},
            {"rows", forecast.rows},
            {"workers", explained.workers},
            {"steps", std::move(steps)},
            {"left_out", std::move(left_out)},
            {"zero_channels", zero_channels(job, explained)}};
}

}  // namespace osio::tool
