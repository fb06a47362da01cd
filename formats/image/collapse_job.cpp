// SPDX-License-Identifier: Apache-2.0
#include <formats/image/collapse_job.h>
#include <formats/image/open_image.h>

#include <osio/collapse/selection.h>
#include <osio/collapse/text_loader.h>

#include <algorithm>

namespace osio::image {

std::vector<std::string> CollapseJob::channel_names() const {
    std::vector<std::string> names = plan.channel_names();
    if (alpha)
        names.emplace_back("A");
    return names;
}

std::vector<SampleType> CollapseJob::column_types() const {
    std::vector<SampleType> types;
    for (const PlanColumn& column : plan.columns)
        types.push_back(part().channels[column.channel].delivered());
    return types;
}

std::vector<SampleType> CollapseJob::plane_types() const {
    std::vector<SampleType> types = column_types();
    if (alpha)
        types.push_back(part().channels[*alpha].delivered());
    return types;
}

Result<std::unique_ptr<BlockSource>> open_source(std::span<const CollapseJob> jobs,
                                                 std::span<const CollapsePlan> beside, Grain grain) {
    const CollapseJob& first = jobs.front();
    PlaneChannels planes;
    for (std::size_t column = 0; column < first.plan.columns.size(); ++column) {
        const bool needed =
            std::any_of(jobs.begin(), jobs.end(),
                        [column](const CollapseJob& job) { return job.plan.weights.needs(column); }) ||
            std::any_of(beside.begin(), beside.end(),
                        [column](const CollapsePlan& plan) { return plan.weights.needs(column); });
        planes.push_back(needed ? std::optional(first.plan.columns[column].channel) : std::nullopt);
    }
    if (first.alpha)
        planes.emplace_back(first.alpha);
    return first.file->make_block_source(first.part_index, std::move(planes), grain);
}

Result<CollapseJob> open_collapse(const std::string& path, const CollapseRequest& request,
                                  const TextLoader& load_text) {
    OSIO_TRY(const OpenWords words, load_open_words(request, load_text));
    OSIO_TRY(auto file, open_image(path, words));
    return prepare_collapse(std::move(file), request, load_text);
}

Result<CollapseJob> prepare_collapse(std::shared_ptr<const SpectralImage> file,
                                     const CollapseRequest& request, const TextLoader& load_text) {
    OSIO_TRY(const Selection selection, file->select(request));
    const Part& part = file->parts()[selection.part];
    const ChannelLayout& layout = part.layout;
    const SpectralSet& set = layout.sets[selection.set];
    auto plan = make_plan(layout.sets, selection.set, part.metadata, request, load_text);
    if (!plan)
        return fail_in(file->path(), std::move(plan).error());
    for (const PlanColumn& column : plan->columns)
        if (part.channels[column.channel].subsampled)
            return fail(ErrorCode::Unsupported,
                        "band \"" + layout.channel_names[column.channel] + "\" is sub-sampled", file->path());

    CollapseJob job{std::move(file), selection.part, std::move(*plan), layout.alpha_of(set), layout.warnings};
    if (job.alpha && job.part().channels[*job.alpha].subsampled)
        return fail(ErrorCode::Unsupported, "alpha is sub-sampled", job.file->path());
    job.warnings.insert(job.warnings.end(), job.plan.warnings.begin(), job.plan.warnings.end());
    return job;
}

Result<std::vector<CollapseJob>> open_collapses(const std::string& path, const CollapseRequest& request,
                                                const TextLoader& load_text) {
    OSIO_TRY(const OpenWords words, load_open_words(request, load_text));
    OSIO_TRY(const std::shared_ptr<const SpectralImage> file, open_image(path, words));
    return prepare_collapses(file, request, load_text);
}

Result<std::vector<CollapseJob>> prepare_collapses(const std::shared_ptr<const SpectralImage>& file,
                                                   const CollapseRequest& request,
                                                   const TextLoader& load_text) {
    OSIO_TRY(const auto requests, requests_by_light(request));
    std::vector<CollapseJob> jobs;
    for (const CollapseRequest& one : requests) {
        OSIO_TRY(CollapseJob job, prepare_collapse(file, one, load_text));
        for (const CollapseJob& other : jobs)
            if (other.plan.request.illuminant == job.plan.request.illuminant)
                return fail(ErrorCode::Usage, "illuminant=" + request.illuminant + " names " +
                                                  job.plan.request.illuminant + " twice");
        jobs.push_back(std::move(job));
    }
    return jobs;
}

}  // namespace osio::image
