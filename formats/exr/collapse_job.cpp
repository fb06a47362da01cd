// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/collapse_job.h>

#include <osio/collapse/selection.h>

namespace osio::exr {

std::vector<std::string> CollapseJob::channel_names() const {
    std::vector<std::string> names = plan.channel_names();
    if (alpha)
        names.emplace_back("A");
    return names;
}

Result<std::unique_ptr<BlockSource>> CollapseJob::open_source(Grain grain) const {
    PlaneChannels planes;
    for (std::size_t band = 0; band < plan.bands.size(); ++band)
        planes.push_back(plan.weights.needs(band) ? std::optional(plan.bands[band].channel) : std::nullopt);
    if (alpha)
        planes.emplace_back(alpha);
    return make_block_source(file, part_index, std::move(planes), grain);
}

std::vector<SampleType> CollapseJob::plane_types() const {
    std::vector<SampleType> types;
    for (const Band& band : plan.bands)
        types.push_back(part().channels[band.channel].type);
    if (alpha)
        types.push_back(part().channels[*alpha].type);
    return types;
}

Result<CollapseJob> open_collapse(const std::string& path, const CollapseRequest& request,
                                  const TextLoader& load_text) {
    OSIO_TRY(auto file, ExrFile::open(path));
    return prepare_collapse(std::move(file), request, load_text);
}

Result<CollapseJob> prepare_collapse(std::shared_ptr<const ExrFile> file, const CollapseRequest& request,
                                     const TextLoader& load_text) {
    const auto summaries = file->summaries();
    const auto selection = select_set(summaries, request);
    if (!selection)
        return fail_in(file->path(), selection.error());
    const ExrPart& part = file->parts()[selection->part];
    const ChannelLayout& layout = part.layout;
    const SpectralSet& set = layout.sets[selection->set];
    auto plan = make_plan(set, part.metadata, request, load_text);
    if (!plan)
        return fail_in(file->path(), std::move(plan).error());

    CollapseJob job{std::move(file), selection->part, std::move(*plan), layout.alpha_of(set),
                    layout.warnings};
    if (job.alpha && job.part().channels[*job.alpha].subsampled)
        return fail(ErrorCode::Unsupported, "alpha is sub-sampled", job.file->path());
    job.warnings.insert(job.warnings.end(), job.plan.warnings.begin(), job.plan.warnings.end());
    return job;
}

}  // namespace osio::exr
