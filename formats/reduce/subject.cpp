// SPDX-License-Identifier: Apache-2.0
#include <formats/image/open_image.h>
#include <formats/image/white_luminance.h>
#include <formats/reduce/subject.h>

#include <osio/base/text.h>
#include <osio/collapse/text_loader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace osio::reduce {

namespace {

Result<void> check_words(const Request& request) {
    if (!(request.tolerance > 0) || !std::isfinite(request.tolerance))
        return fail(ErrorCode::Usage, "found --max-delta-e " + format_double(request.tolerance) +
                                          ", expected a CIEDE2000 above 0, such as 0.5");
    if (request.observers.empty())
        return fail(ErrorCode::Usage, "no observer is named; expected names of `osiotool list observers`");
    const std::string output = to_lower(request.output);
    if (!output.ends_with(".exr") && !output.ends_with(".spexr"))
        return fail(ErrorCode::Usage, "expected an output that ends in .exr or .spexr", request.output);
    std::error_code ignored;
    if (request.input == request.output ||
        std::filesystem::equivalent(request.input, request.output, ignored))
        return fail(
            ErrorCode::Usage,
            "the output is the input, of which bands are lost that no file would have; expected another name",
            request.output);
    return {};
}

/// `named`: the set is what was asked for, not what was left to us.
Result<void> check_set(const image::CollapseJob& job, bool named) {
    const SpectralSet& set = job.set();
    const std::string& path = job.file->path();
    if (!set.reradiation.empty())
        return fail(ErrorCode::Unsupported,
                    "set " + set.name() +
                        " is fluorescent: what comes out at one wavelength depends on the light at others, "
                        "which fewer "
                        "bands do not hold; expected bands alone",
                    path);
    if (set.family == Family::S1 || set.family == Family::S2 || set.family == Family::S3)
        return fail(
            ErrorCode::Unsupported,
            "set " + set.name() +
                " is a Stokes component, a difference of intensities that has no colour to be kept; expected "
                "S0 or T",
            path);
    for (const SpectralSet& other : job.part().layout.sets)
        if (set.family == Family::S0 && other.root == set.root && &other != &set &&
            other.family != Family::T && !named)
            return fail(ErrorCode::Unsupported,
                        "set " + set.name() + " comes with " + other.name() +
                            ", polarisation that would be lost; --set " + set.name() +
                            " reduces the intensity alone",
                        path);
    return {};
}

/// A light or observer that is named twice would only cost time, but is hardly meant.
Result<void> check_distinct(const Subject& subject) {
    for (std::size_t i = 0; i < subject.demands.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (subject.demands[i].name() == subject.demands[j].name())
                return fail(ErrorCode::Usage, "found " + subject.demands[i].name() +
                                                  " twice among lights and observers; expected it once");
    return {};
}

}  // namespace

void Subject::add(image::CollapseJob job, double luminance) {
    weights.append(job.plan.weights);
    demands.push_back(make_demand(job.plan, luminance));
    jobs.push_back(std::move(job));
}

Result<Subject> open_subject(const Request& request, const TextLoader& load_text, Runner& runner,
                             const Progress& progress) {
    OSIO_CHECK_OK(check_words(request));
    OSIO_TRY(const OpenWords words, load_open_words(request.words, load_text));
    OSIO_TRY(const std::shared_ptr<const image::SpectralImage> file, image::open_image(request.input, words));
    OSIO_TRY(const Selection selection, file->select(request.words));
    const SpectralSet& set = file->parts()[selection.part].layout.sets[selection.set];
    const bool radiance = set.quantity() == Quantity::Radiance;
    if (radiance && !request.lights.empty())
        return fail(
            ErrorCode::Usage,
            "set " + set.name() +
                " is radiance, which holds its light already and looks the same under no other; leave out "
                "--lights, and name --observers",
            request.input);
    if (!radiance && request.lights.empty())
        return fail(
            ErrorCode::MissingIlluminant,
            "set " + set.name() +
                " is reflectance, whose colours depend on the light; expected --lights, such as D65,A,FL11",
            request.input);
    Subject out;
    for (const std::string& light : radiance ? std::vector<std::string>{""} : request.lights)
        for (const std::string& observer : request.observers) {
            CollapseRequest one = request.words;
            OSIO_TRY(one.to, find_output_space("xyz"));
            one.illuminant = light;
            one.observer = observer;
            OSIO_TRY(image::CollapseJob job, image::prepare_collapse(file, one, load_text));
            OSIO_CHECK_OK(check_set(job, !request.words.set.empty()));
            OSIO_TRY(const image::WhiteLuminance white,
                     image::white_luminance_of(job, load_text, runner, progress));
            if (out.jobs.empty()) {
                out.white_luminance = white.y;
                out.white_reason = white.reason;
            }
            out.add(std::move(job), white.y);
        }
    OSIO_CHECK_OK(check_distinct(out));
    return out;
}

Subject other_demands(const Subject& subject, const TextLoader& load_text) {
    Subject out;
    const CollapseRequest& first = subject.job().plan.request;
    const bool radiance = !subject.job().plan.illuminant;
    for (const std::string& name : radiance ? observer_names() : illuminant_names()) {
        const bool named =
            std::any_of(subject.demands.begin(), subject.demands.end(), [&](const Demand& demand) {
                return iequals(radiance ? demand.plan.observer.id : demand.plan.illuminant->id, name);
            });
        if (named)
            continue;
        CollapseRequest one = first;
        (radiance ? one.observer : one.illuminant) = name;
        // A light without power where the bands are, or an observer without X, Y, Z, says nothing here.
        if (auto job = image::prepare_collapse(subject.job().file, one, load_text))
            out.add(std::move(*job), subject.white_luminance);
    }
    return out;
}

}  // namespace osio::reduce
