// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/choice.h>
#include <formats/envi/attribute_fields.h>
#include <formats/exr/spectral_header.h>
#include <formats/image/derived_image.h>
#include <formats/image/header_attributes.h>
#include <formats/image/preview_plan.h>
#include <formats/image/scene_basis.h>
#include <formats/reduce/candidate.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>

namespace osio::reduce {

namespace {

/// The attributes that say nothing once the bands are others, or fewer.
std::vector<std::string> attributes_of_bands(const Imf::Header& header) {
    std::vector<std::string> out;
    for (auto a = header.begin(); a != header.end(); ++a) {
        const std::string name = a.name();
        const bool counts = name.starts_with(envi::kAttributePrefix) &&
                            envi::counts_bands(name.substr(envi::kAttributePrefix.size()));
        if (counts || name == attribute::kBasis || name == attribute::kBinEdges || name == attribute::kFwhm ||
            parse_channel_name(name, DecimalMark::Comma))
            out.push_back(name);
    }
    return out;
}

/// The original's attributes, without those of a picture or of an earlier reduction.
Imf::Header header_of(const Subject& subject) {
    Imf::Header out = convert::attributes_of(subject.job().part());
    image::erase_attributes({image::attribute::kPreviewRecipe, std::string(attribute::kReduction)}, out);
    return out;
}

void set_text(std::string_view name, std::string text, Imf::Header& header) {
    header.insert(std::string(name), Imf::StringAttribute(std::move(text)));
}

/// The plans of every demand for a candidate whose channels are known.
Result<void> complete(const Subject& subject, const TextLoader& load_text, Candidate& candidate) {
    const std::string set = subject.job().set().name();
    candidate.plans.clear();
    const WeightMatrix& bands = candidate.expansion.rows() > 0 ? candidate.expansion : candidate.matrix;
    candidate.weights = WeightMatrix(3 * subject.demands.size(), bands.rows());
    for (std::size_t d = 0; d < subject.demands.size(); ++d) {
        const CollapseRequest& asked = subject.demands[d].plan.request;
        CollapseRequest request;
        request.to = asked.to;
        request.illuminant = asked.illuminant;
        request.observer = asked.observer;
        request.set = set;
        const auto& sets = candidate.part.layout.sets;
        const auto chosen = static_cast<std::size_t>(candidate.part.layout.find_set(set) - sets.data());
        OSIO_TRY(CollapsePlan plan, make_plan(sets, chosen, candidate.part.metadata, request, load_text));
        for (std::size_t column = 0; column < plan.columns.size(); ++column)
            for (std::size_t c = 0; c < 3; ++c)
                candidate.weights.at(3 * d + c, plan.columns[column].channel) = plan.weights.at(c, column);
        candidate.plans.push_back(std::move(plan));
    }
    return {};
}

Result<Candidate> describe(const Subject& subject, std::vector<image::Channel> channels, Imf::Header header,
                           Candidate candidate, const TextLoader& load_text) {
    const image::CollapseJob& job = subject.job();
    if (job.alpha)
        channels.push_back({job.set().root.empty() ? "A" : job.set().root + ".A",
                            job.part().channels[*job.alpha].delivered(), false});
    std::vector<std::string> names;
    for (const image::Channel& channel : channels)
        names.push_back(channel.name);
    exr::complete_spectral_header(parse_channel_layout(names, DecimalMark::Comma), header);
    if (candidate.stored.empty())
        candidate.stored = channels;
    else if (job.alpha)
        candidate.stored.push_back(channels.back());
    candidate.part = image::described_part(std::move(channels), std::move(header));
    OSIO_CHECK_OK(complete(subject, load_text, candidate));
    return candidate;
}

}  // namespace

Result<Candidate> bin_candidate(const Subject& subject, const BinFit& fit, std::vector<double> edges_nm,
                                double fidelity, SampleType type, const TextLoader& load_text) {
    const SpectralSet& set = subject.job().set();
    std::vector<image::Channel> channels;
    std::vector<std::string> edges;
    for (const double nm : edges_nm)
        edges.push_back(format_double(nm));
    for (std::size_t bin = 0; bin + 1 < edges_nm.size(); ++bin)
        channels.push_back(
            {format_channel_name({set.root, set.family, (edges_nm[bin] + edges_nm[bin + 1]) / 2, {}},
                                 DecimalMark::Comma),
             type, false});
    Imf::Header header = header_of(subject);
    const std::vector<std::string> of_bands = attributes_of_bands(header);
    image::erase_attributes({of_bands.begin(), of_bands.end()}, header);
    set_text(attribute::kBasis, std::string(basis_name(Basis::Bins)), header);
    set_text(attribute::kBinEdges, join(edges, ";"), header);
    Candidate out;
    const WeightMatrix weights = fit.weights(edges_nm);
    out.matrix = fit.fit(edges_nm, weights, fidelity, fit.bands());
    out.metric = fit.metric(weights, fidelity);
    out.edges_nm = std::move(edges_nm);
    out.type = type;
    out.fidelity = fidelity;
    return describe(subject, std::move(channels), std::move(header), std::move(out), load_text);
}

Result<Candidate> whole_candidate(const Subject& subject, SampleType type, const TextLoader& load_text) {
    const image::CollapseJob& job = subject.job();
    const std::vector<std::string> names = image::derived_names(job.part());
    std::vector<image::Channel> channels;
    Candidate out;
    std::vector<std::size_t> kept;  // the rest has no colour for anyone here
    for (std::size_t column = 0; column < subject.columns(); ++column)
        if (subject.weights.needs(column))
            kept.push_back(column);
    out.matrix = WeightMatrix(kept.size(), subject.columns());
    out.metric = WeightMatrix(kept.size(), kept.size());
    for (std::size_t row = 0; row < kept.size(); ++row) {
        channels.push_back({names[job.plan.columns[kept[row]].channel], type, false});
        out.matrix.at(row, kept[row]) = out.metric.at(row, row) = 1;
    }
    Imf::Header header = header_of(subject);
    set_text(attribute::kBasis, std::string(basis_name(job.plan.basis.basis)), header);
    out.type = type;
    return describe(subject, std::move(channels), std::move(header), std::move(out), load_text);
}

Result<Candidate> scene_candidate(const Subject& subject, const SceneFit& fit, std::size_t count,
                                  double fidelity, SampleType type, const TextLoader& load_text) {
    const image::CollapseJob& job = subject.job();
    const std::vector<std::string> names = image::derived_names(job.part());
    std::vector<image::Channel> channels;
    for (const std::size_t column : fit.columns())
        channels.push_back({names[job.plan.columns[column].channel], SampleType::Float, false});
    SceneBasis basis = fit.first(count);
    Candidate out;
    for (std::size_t k = 0; k < count; ++k)
        out.stored.push_back({image::coefficient_name(k), type, false});
    out.matrix = std::move(basis.coefficients);
    out.expansion = std::move(basis.expansion);
    out.type = type;
    out.fidelity = fidelity;
    Imf::Header header = header_of(subject);
    set_text(attribute::kBasis, std::string(basis_name(job.plan.basis.basis)), header);
    return describe(subject, std::move(channels), std::move(header), std::move(out), load_text);
}

Imf::Header written_header(const Candidate& candidate) {
    Imf::Header out = candidate.part.header;
    if (candidate.expansion.rows() == 0)
        return out;
    std::vector<std::string> bands;
    for (std::size_t band = 0; band < candidate.expansion.rows(); ++band)
        bands.push_back(candidate.part.channels[band].name);
    set_text(image::attribute::kSceneBasis, image::scene_basis_text(bands, candidate.expansion), out);
    return out;
}

Result<Candidate> for_demands(const Candidate& candidate, const Subject& other, const TextLoader& load_text) {
    Candidate out = candidate;
    OSIO_CHECK_OK(complete(other, load_text, out));
    return out;
}

std::vector<std::string> losses(const Subject& subject, const Candidate& candidate) {
    const image::CollapseJob& job = subject.job();
    const image::Part& part = job.part();
    std::vector<std::string> out, channels;
    for (const std::size_t channel : part.layout.others)
        if (channel != job.alpha)
            channels.push_back(part.layout.channel_names[channel]);
    if (!channels.empty())
        out.push_back((channels.size() > 1 ? "channels " : "channel ") + convert::names_text(channels));
    for (const SpectralSet& set : part.layout.sets)
        if (set.name() != job.set().name())
            out.push_back("set " + set.name());
    if (const std::size_t others = job.file->parts().size() - 1; others > 0)
        out.push_back(std::to_string(others) + " other part" + (others > 1 ? "s" : ""));
    if (const std::size_t kept = candidate.weights.bands();
        candidate.edges_nm.empty() && kept < subject.columns())
        out.push_back(std::to_string(subject.columns() - kept) +
                      " bands that no light and observer here sees");
    if (!candidate.edges_nm.empty())
        if (const auto names = attributes_of_bands(part.header); !names.empty())
            out.push_back((names.size() > 1 ? "attributes " : "attribute ") + convert::names_text(names) +
                          ", of the bands before");
    return out;
}

}  // namespace osio::reduce
