// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/exr/reserved_text.h>
#include <formats/reduce/reduction.h>
#include <formats/reduce/search.h>
#include <formats/reduce/write_pass.h>

#include <osio/base/text.h>
#include <osio/layout/spectral_metadata.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace osio::reduce {

namespace {

/// What decodes to the samples that were judged.
constexpr std::array<std::string_view, 5> kLossless{"none", "rle", "zips", "zip", "piz"};

/// Samples as they are are read fastest, and are taken where they make a file this many times smaller than the
/// original's; else zip, the next: docs/design/0016-reduce.md.
constexpr std::uint64_t kPlainShare = 8;

Result<void> check_compression(const std::string& name) {
    if (name.empty())
        return {};
    OSIO_TRY([[maybe_unused]] const Imf::Compression known, exr::find_compression(name));
    if (std::find(kLossless.begin(), kLossless.end(), to_lower(name)) == kLossless.end())
        return fail(ErrorCode::Unsupported,
                    "compression " + name +
                        " changes samples after they were verified; expected none, rle, zips, "
                        "zip or piz");
    return {};
}

/// The compression that was asked for, or the one that is read fastest.
std::string compression_of(const Request& request, const Reduction& reduction, const Candidate& candidate,
                           std::uint64_t pixels) {
    if (!request.compression.empty())
        return to_lower(request.compression);
    const std::uint64_t plain = pixels * candidate.matrix.rows() * sample_bytes(candidate.type);
    return plain * kPlainShare <= reduction.source_bytes ? "none" : "zip";
}

std::uint64_t size_of_file(const std::string& path) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(path, failed);
    return failed ? 0 : size;
}

std::string demands_text(const Subject& subject) {
    std::vector<std::string> names;
    for (const Demand& demand : subject.demands)
        names.push_back(demand.name());
    return join(names, "; ");
}

/// What is known before a pixel is written.
Reduction start_reduction(const Request& request, const Subject& subject) {
    const image::CollapseJob& job = subject.job();
    Reduction out;
    out.source = std::filesystem::path(request.input).filename().string();
    out.source_bytes = size_of_file(request.input);
    out.source_bands = subject.columns();
    out.source_samples = sample_type_name(job.part().channels[job.plan.columns.front().channel].type);
    out.set = job.set().name();
    out.tolerance = request.tolerance;
    out.white_luminance = subject.white_luminance;
    out.white_reason = subject.white_reason;
    return out;
}

/// What a candidate is, and what the sample tells of it.
Result<void> describe(const Subject& subject, const Subject& others, const Candidate& candidate,
                      const SpectrumSample& sample, const TextLoader& load_text, Reduction& out) {
    out.wavelengths_nm = candidate.plans.front().wavelengths_nm();
    out.edges_nm = candidate.edges_nm;
    out.coefficients = candidate.expansion.bands();
    out.basis = basis_name(candidate.plans.front().basis.basis);
    out.samples = sample_type_name(candidate.type);
    out.fidelity = candidate.fidelity;
    out.demands.clear();
    for (std::size_t d = 0; d < subject.demands.size(); ++d) {
        const CollapsePlan& plan = subject.demands[d].plan;
        out.demands.push_back({plan.illuminant ? plan.illuminant->id : std::string(), plan.observer.id,
                               plan.id, candidate.plans[d].id});
    }
    out.sampled_pixels = sample.size();
    const SpectrumLoss loss = spectrum_loss(subject, candidate, sample);
    out.spectrum_rms = loss.rms;
    out.spectrum_largest = loss.largest;
    out.others.clear();
    if (!others.demands.empty()) {
        OSIO_TRY(const Candidate seen, for_demands(candidate, others, load_text));
        const std::vector<double> largest = largest_differences(others, seen, sample);
        for (std::size_t d = 0; d < others.demands.size(); ++d) {
            const CollapsePlan& plan = others.demands[d].plan;
            out.others.push_back(
                {plan.illuminant ? plan.illuminant->id : std::string(), plan.observer.id, largest[d]});
        }
    }
    out.lost = losses(subject, candidate);
    return {};
}

void add_pass(const PassResult& pass, std::uint64_t pixels, Reduction& out) {
    out.pixels = pixels;
    for (std::size_t d = 0; d < pass.found.size(); ++d) {
        const PassResult::Found& found = pass.found[d];
        out.demands[d].largest = found.largest;
        out.demands[d].mean = found.pixels > 0 ? found.sum / static_cast<double>(found.pixels) : 0;
        out.demands[d].largest_at = found.largest_at;
        out.demands[d].undefined = found.undefined;
    }
    out.changed_pixels = pass.counts.changed;
    out.negative_samples = pass.counts.negative;
    out.clamped_samples = pass.counts.clamped;
}

tl::unexpected<Error> not_reached(const Request& request, const Subject& subject, const std::string& why) {
    return fail(ErrorCode::NotCertified,
                "no fewer bytes a pixel than those of its " + std::to_string(subject.columns()) +
                    " bands keep every pixel within a CIEDE2000 of " + format_double(request.tolerance) +
                    " under " + demands_text(subject) + why +
                    "; expected a larger --max-delta-e, or fewer lights and observers. Nothing was written",
                request.input);
}

}  // namespace

std::vector<std::string> Reduction::not_for() const {
    std::vector<std::string> out;
    for (const OtherResult& other : others)
        if (!(other.largest <= tolerance))
            out.push_back(other.light.empty() ? other.observer : other.light);
    return out;
}

Result<Outcome> reduce(const Request& request, const TextLoader& load_text, Runner& runner,
                       const Progress& progress) {
    OSIO_CHECK_OK(check_compression(request.compression));
    OSIO_TRY(Subject subject, open_subject(request, load_text, runner, progress));
    const Subject others = other_demands(subject, load_text);
    for (const Demand& other : others.demands)
        subject.beside.push_back(other.plan);
    const BinFit fit(subject.demands);
    OSIO_TRY(SpectrumSample sample, sample_image(subject, runner, progress));
    Outcome out;
    out.output = request.output;
    out.warnings = subject.job().warnings;
    out.reduction = start_reduction(request, subject);
    const image::Window& window = subject.job().part().data_window;
    out.width = window.width();
    out.height = window.height();
    const auto pixels = static_cast<std::uint64_t>(out.width) * static_cast<std::uint64_t>(out.height);
    const auto find = request.scene_basis ? find_scene_candidate : find_candidate;
    while (out.passes < request.most_passes) {
        OSIO_TRY(std::optional<Candidate> candidate,
                 find(subject, fit, sample, request.tolerance, load_text));
        if (!candidate)
            return not_reached(request, subject, "");
        OSIO_CHECK_OK(describe(subject, others, *candidate, sample, load_text, out.reduction));
        Imf::Header header = written_header(*candidate);
        out.reduction.compression = compression_of(request, out.reduction, *candidate, pixels);
        OSIO_TRY(header.compression(), exr::find_compression(out.reduction.compression));
        exr::reserve_text(std::string(attribute::kReduction), most_reduction_bytes(out.reduction), header);
        std::vector<exr::OutputChannel> channels;
        for (const image::Channel& channel : candidate->stored)
            channels.push_back({channel.name, channel.type});
        OSIO_TRY(const auto writer, exr::ExrWriter::create(request.output, std::move(header), channels));
        OSIO_TRY(const PassResult pass,
                 write_pass(subject, *candidate, request.tolerance, *writer, runner, progress));
        ++out.passes;
        if (pass.within(request.tolerance)) {
            add_pass(pass, pixels, out.reduction);
            writer->set_text(0, std::string(attribute::kReduction), reduction_json(out.reduction, true));
            OSIO_CHECK_OK(writer->finish(request.durability));
            out.bytes = size_of_file(request.output);
            return out;
        }
        if (pass.unsampled > 0)
            return not_reached(
                request, subject,
                ": " + std::to_string(pass.unsampled) +
                    " pixels hold NaN or infinities in bands that hardly count, which spread to others");
        for (std::size_t i = 0; i < pass.beyond.size(); ++i)
            sample.add(pass.beyond.pixel(i));
    }
    return not_reached(request, subject, ", after " + std::to_string(request.most_passes) + " attempts");
}

}  // namespace osio::reduce
