// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/collapse_output.h>
#include <tools/osiotool/host_loader.h>

#include <formats/exr/exr_writer.h>
#include <formats/exr/output_header.h>
#include <formats/exr/reserved_text.h>

#include <osio/base/text.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace osio::tool {

using host::StoredType;

namespace {

constexpr std::array<std::pair<std::string_view, StoredType>, 4> kDepths{{{"half", StoredType::Half},
                                                                          {"float", StoredType::Float},
                                                                          {"uint8", StoredType::Uint8},
                                                                          {"uint16", StoredType::Uint16}}};

constexpr std::string_view kIlluminantMark = "{illuminant}";

bool is_exr(std::string_view path) {
    return to_lower(path).ends_with(".exr");
}

bool is_integer(StoredType type) {
    return type == StoredType::Uint8 || type == StoredType::Uint16;
}

files::Durability durability_of(const CollapseOptions& options) {
    return options.fsync ? files::Durability::Stored : files::Durability::Handed;
}

/// What all outputs of a collapse have in common.
struct OutputRequest {
    const CollapseOptions& options;
    const std::vector<exr::BadRows>& missing;
    StoredType type;
    bool certified;
};

Imf::Header header_of(const image::CollapseJob& job, const OutputRequest& request) {
    Imf::Header header = exr::collapsed_header(job);
    exr::note_missing_rows(request.missing, header);
    return header;
}

/// A job's part of an EXR.
Result<exr::OutputPart> part_for(const image::CollapseJob& job, const OutputRequest& request,
                                 SampleType sample) {
    Imf::Header header = header_of(job, request);
    const std::string& compression = request.options.compression;
    if (!compression.empty()) {
        OSIO_TRY(header.compression(), exr::find_compression(compression));
    }
    if (request.certified)
        exr::reserve_text(image::attribute::kCertificate, image::most_certificate_bytes(job), header);
    exr::OutputPart part{std::move(header), {}};
    for (const std::string& name : job.channel_names())
        part.channels.push_back({name, sample});
    return part;
}

/// One EXR for all jobs: a part each, with the light's name where there are several.
Result<std::vector<CollapseOutput>> open_exr(const OutputRequest& request, const std::string& path,
                                             std::span<const image::CollapseJob> jobs,
                                             std::span<const std::string> names) {
    const SampleType sample = request.type == StoredType::Half ? SampleType::Half : SampleType::Float;
    std::vector<exr::OutputPart> parts;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        OSIO_TRY(exr::OutputPart part, part_for(jobs[i], request, sample));
        if (jobs.size() > 1)
            part.header.setName(names[i]);
        parts.push_back(std::move(part));
    }
    OSIO_TRY(std::shared_ptr<exr::ExrWriter> writer, exr::ExrWriter::create(path, std::move(parts)));
    std::vector<CollapseOutput> out;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        auto sink = std::make_unique<exr::ExrSink>(writer, sample, jobs[i].part().data_window.width(), i);
        auto* const exr = sink.get();
        const bool last = i + 1 == jobs.size();
        const auto durability = durability_of(request.options);
        out.push_back({std::move(sink),
                       [exr, last, durability, job = &jobs[i]](CollapseOutcome& outcome) {
                           outcome.clamped_samples = exr->clamped_count();
                           if (outcome.certificate)
                               exr->set_text(image::attribute::kCertificate,
                                             image::certificate_json(*job, *outcome.certificate, true));
                           return last ? exr->finish(durability) : Result<void>();
                       },
                       path});
    }
    return out;
}

Result<CollapseOutput> open_other(const OutputRequest& request, const std::string& path,
                                  const image::CollapseJob& job) {
    if (!request.options.compression.empty())
        return fail(ErrorCode::Usage, "--compression is for .exr output");
    OSIO_TRY(const host::HostModule* const module, load_host_module());
    const Imf::Header header = header_of(job, request);
    OSIO_TRY(auto sink, module->open_sink({path, request.type, job.channel_names(), &header,
                                           durability_of(request.options)}));
    auto* const other = sink.get();
    return CollapseOutput{std::move(sink),
                          [other](CollapseOutcome& outcome) {
                              outcome.clipped_pixels = other->clipped_pixels();
                              return other->finish();
                          },
                          path};
}

/// The lights' names for files and parts. Usage where there is no light or two have the same name.
Result<std::vector<std::string>> names_of(const std::vector<image::CollapseJob>& jobs, bool needed) {
    std::vector<std::string> names;
    if (!needed)
        return names;
    for (const image::CollapseJob& job : jobs) {
        if (!job.plan.illuminant)
            return fail(ErrorCode::Usage, "the output's name holds " + std::string(kIlluminantMark) +
                                              ", and there is no light to name: the bands are radiance");
        const std::string& id = job.plan.illuminant->id;
        std::string name = is_table_path(id) ? std::filesystem::path(id).stem().string() : id;
        if (std::find(names.begin(), names.end(), name) != names.end())
            return fail(ErrorCode::Usage, "two lights have the name " + name + " in the output");
        names.push_back(std::move(name));
    }
    return names;
}

/// True where equal steps of the values are equal steps of light.
bool is_linear(const OutputSpace& space) {
    return space.transform ? space.transform->is_linear() : space.transfer == Transfer::Linear;
}

}  // namespace

std::string_view depth_name(StoredType type) {
    for (const auto& [name, known] : kDepths)
        if (known == type)
            return name;
    return {};
}

Result<StoredType> choose_depth(const CollapseOptions& options, const OutputSpace& space) {
    StoredType type = StoredType::Float;
    if (options.depth.empty()) {
        type = !is_exr(options.output) && !is_linear(space) ? StoredType::Uint8 : StoredType::Float;
    } else {
        std::vector<std::string> names;
        bool found = false;
        for (const auto& [name, known] : kDepths) {
            names.emplace_back(name);
            if (iequals(name, options.depth)) {
                type = known;
                found = true;
            }
        }
        if (!found)
            return fail(ErrorCode::UnknownName,
                        "there is no depth \"" + options.depth + "\"" + suggestion(options.depth, names));
    }
    if (is_integer(type) && is_exr(options.output))
        return fail(ErrorCode::Usage, "an .exr stores half or float, not " + std::string(depth_name(type)));
    const bool degree = is_polarisation(space.kind) && space.kind != SpaceKind::AoLP;
    if (is_integer(type) && !is_tristimulus(space.kind) && !degree)
        return fail(ErrorCode::Usage, space.id + " holds values beyond 0 to 1, which " +
                                          std::string(depth_name(type)) + " does not; use -d half or float");
    if (is_integer(type) && is_linear(space) && !degree && !options.raw)
        return fail(ErrorCode::Usage,
                    space.id + " is linear, and " + std::string(depth_name(type)) +
                        " has too few steps for it in the shadows; use --to srgb, -d half, or --raw "
                        "to do it all the same");
    return type;
}

std::vector<StoredType> depth_candidates(const CollapseOptions& options, const CollapsePlan& plan,
                                         StoredType chosen) {
    if (plan.request.max_delta_e && options.depth.empty() && is_exr(options.output))
        return {StoredType::Half, StoredType::Float};
    return {chosen};
}

StoredDepth stored_depth(StoredType type) {
    switch (type) {
    case StoredType::Half: return StoredDepth::Half;
    case StoredType::Uint8: return StoredDepth::Uint8;
    case StoredType::Uint16: return StoredDepth::Uint16;
    case StoredType::Float: break;
    }
    return StoredDepth::Float;
}

Result<std::vector<CollapseOutput>> open_outputs(const CollapseOptions& options,
                                                 const std::vector<image::CollapseJob>& jobs,
                                                 const std::vector<exr::BadRows>& missing, StoredType type,
                                                 bool certified) {
    const OutputRequest request{options, missing, type, certified};
    const bool marked = options.output.find(kIlluminantMark) != std::string::npos;
    if (!marked && jobs.size() > 1 && !is_exr(options.output))
        return fail(ErrorCode::Usage,
                    "several lights need an .exr, which then has as many parts, or several files: expected " +
                        std::string(kIlluminantMark) + " in the output's name");
    OSIO_TRY(const auto names, names_of(jobs, marked || jobs.size() > 1));
    if (!marked && is_exr(options.output))
        return open_exr(request, options.output, jobs, names);
    std::vector<CollapseOutput> out;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        std::string path = options.output;
        for (std::size_t at = 0; (at = path.find(kIlluminantMark, at)) != std::string::npos;
             at += names[i].size())
            path.replace(at, kIlluminantMark.size(), names[i]);
        if (is_exr(path)) {
            OSIO_TRY(auto one, open_exr(request, path, {&jobs[i], 1}, {}));
            out.push_back(std::move(one.front()));
        } else {
            OSIO_TRY(auto one, open_other(request, path, jobs[i]));
            out.push_back(std::move(one));
        }
    }
    return out;
}

}  // namespace osio::tool
