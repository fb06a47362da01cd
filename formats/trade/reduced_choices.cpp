// SPDX-License-Identifier: Apache-2.0
#include <formats/image/open_image.h>
#include <formats/reduce/reduction.h>
#include <formats/trade/progress_part.h>
#include <formats/trade/reduced_choices.h>

#include <osio/base/text.h>

#include <algorithm>
#include <array>

namespace osio::trade {

namespace {

/// CIEDE2000: not to be seen side by side, and hardly to be seen.
constexpr std::array<double, 2> kTolerances{0.5, 2};

/// Of a search for each; images that need more, such as noise in every band, have no such choice.
constexpr int kMostPasses = 3;

/// Daylight, tungsten, a fluorescent lamp and a LED, beside the job's own.
constexpr std::array<std::string_view, 4> kLights{"D65", "A", "FL11", "LED-B3"};

std::vector<std::string> lights_of(const image::CollapseJob& job) {
    std::vector<std::string> out;
    if (!job.plan.illuminant)
        return out;
    out.push_back(job.plan.illuminant->id);
    for (const std::string_view light : kLights)
        if (light != out.front())
            out.emplace_back(light);
    return out;
}

reduce::Request request_for(const image::CollapseJob& job, double tolerance) {
    const CollapseRequest& request = job.plan.request;
    reduce::Request out;
    out.input = job.file->path();
    out.words.wavelengths = request.wavelengths;
    out.words.quantity = request.quantity;
    out.words.basis = request.basis;
    out.words.white_luminance = request.white_luminance;
    out.words.part = std::to_string(job.part_index);
    out.words.set = request.set;
    out.lights = lights_of(job);
    out.observers = {request.observer};
    out.tolerance = tolerance;
    out.most_passes = kMostPasses;
    return out;
}

/// True where the image is what cannot be reduced, rather than the machine what fails.
bool is_refusal(ErrorCode code) {
    return code != ErrorCode::Io && code != ErrorCode::Damaged && code != ErrorCode::Cancelled;
}

/// The job's request of the reduced file, which says itself what its bands are.
Result<Choice> choice_of(const image::CollapseJob& job, const reduce::Outcome& outcome, double tolerance,
                         const TextLoader& load_text) {
    CollapseRequest request = job.plan.request;
    request.part.clear();
    request.set.clear();
    request.wavelengths.clear();
    request.quantity.reset();
    request.basis = Basis::Auto;
    OSIO_TRY(const auto file, image::open_image(outcome.output));
    OSIO_TRY(const image::CollapseJob reduced, image::prepare_collapse(file, request, load_text));
    const std::string limit = format_double(tolerance);
    const std::vector<std::string> lights = lights_of(job);
    Choice out;
    out.name = "reduced " + limit;
    out.meaning = "osiotool reduce to " + std::to_string(reduced.plan.bands.size()) + " bands as " +
                  outcome.reduction.samples + " that hold CIEDE2000 " + limit +
                  (lights.empty() ? std::string() : " under " + join(lights, ", "));
    out.input = Input::ReducedImage;
    out.path = outcome.output;
    out.weights = reduced.plan.weights;
    for (const PlanColumn& column : reduced.plan.columns)
        out.file_planes.emplace_back(column.channel);
    out.bands = reduced.plan.bands.size();
    return out;
}

}  // namespace

Result<void> add_reduced_choices(const image::CollapseJob& job, const files::TemporaryFolder& folder,
                                 const TextLoader& load_text, Runner& runner, const Progress& progress,
                                 Choices& choices) {
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        reduce::Request request = request_for(job, kTolerances[i]);
        request.output = folder.path("reduced_" + std::to_string(i) + ".exr");
        const double share = 1.0 / kTolerances.size();
        const auto outcome = reduce::reduce(request, load_text, runner,
                                            progress_part(progress, share * static_cast<double>(i), share));
        if (!outcome && !is_refusal(outcome.error().code))
            return tl::unexpected(outcome.error());
        if (!outcome)
            continue;
        OSIO_TRY(Choice choice, choice_of(job, *outcome, kTolerances[i], load_text));
        choices.list.push_back(std::move(choice));
    }
    return {};
}

}  // namespace osio::trade
