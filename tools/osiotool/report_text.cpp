// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report.h>
#include <tools/osiotool/text_table.h>

#include <osio/base/text.h>
#include <osio/collapse/basis_spread.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace osio::tool {

namespace {

/// Spacings that differ by less are the same: names are decimal, differences are binary.
constexpr double kSameSpacingNm = 1e-6;

/// Channels beyond this many are counted, not named.
constexpr std::size_t kNamedChannels = 12;

/// The pixel types of some channels: "float", or "half and float".
template <class Channels, class IndexOf>
std::string types_text(const image::Part& part, const Channels& channels, IndexOf index_of) {
    std::vector<std::string> names;
    for (const auto& channel : channels) {
        const std::string name(sample_type_name(part.channels[index_of(channel)].type));
        if (std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    return join(names, " and ");
}

std::string window_text(const image::Window& w) {
    return fmt::format("{},{} to {},{}", w.min_x, w.min_y, w.max_x, w.max_y);
}

/// "820 pairs T.in.out, 380-770 nm to 390-780 nm".
std::string reradiation_text(const std::vector<Reradiation>& pairs) {
    double first_nm = pairs[0].emitted_nm, last_nm = first_nm;
    for (const Reradiation& pair : pairs) {
        first_nm = std::min(first_nm, pair.emitted_nm);
        last_nm = std::max(last_nm, pair.emitted_nm);
    }
    return fmt::format("{} pair{} T.in.out, {}-{} nm to {}-{} nm", pairs.size(), pairs.size() == 1 ? "" : "s",
                       format_double(pairs.front().excited_nm), format_double(pairs.back().excited_nm),
                       format_double(first_nm), format_double(last_nm));
}

std::string set_text(const image::Part& part, const SpectralSet& set) {
    const auto of_band = [](const Band& band) { return band.channel; };
    std::string out = fmt::format("  set {}: {}", set.name(), quantity_name(set.quantity()));
    if (set.quantity() == Quantity::Radiance)
        out += " in " + part.metadata.emissive_units.value_or("W.m^-2.sr^-1") + " per nm";
    out += fmt::format(", {} band{}", set.bands.size(), set.bands.size() == 1 ? "" : "s");
    if (!set.bands.empty())
        out += ", " + spacing_text(set.wavelengths_nm()) + ", " + types_text(part, set.bands, of_band);
    if (!set.reradiation.empty())
        out += ", fluorescent: " + reradiation_text(set.reradiation);
    return out + "\n";
}

/// "deep scanlines, zip compression", "bil of uint16, little-endian".
std::string storage_text(const image::Part& part) {
    if (!part.storage.empty())
        return part.storage;
    return fmt::format("{}{}, {} compression", part.deep ? "deep " : "", part.tiled ? "tiles" : "scanlines",
                       part.compression);
}

std::string part_text(const image::Part& part, std::size_t index) {
    std::string out = fmt::format("part {}{}: {}x{} pixels, {} channels, {}\n", index,
                                  part.name.empty() ? "" : " \"" + part.name + "\"", part.data_window.width(),
                                  part.data_window.height(), part.channels.size(), storage_text(part));
    out += "  data window " + window_text(part.data_window);
    out += part.display_window == part.data_window
               ? ", the display window too\n"
               : ", display window " + window_text(part.display_window) + "\n";
    if (part.layout.sets.empty())
        out += "  no spectral bands\n";
    if (const Dialect& dialect = part.layout.dialect; !dialect.name.empty() && dialect.name != kLayoutDialect)
        out += "  dialect " + dialect.name + ": " + dialect.evidence + "\n";
    else if (!part.layout.sets.empty())
        out += "  spectral layout version " + part.metadata.layout_version.value_or("not stated") + "\n";
    for (const SpectralSet& set : part.layout.sets)
        out += set_text(part, set);
    if (!part.metadata.sensitivities.empty())
        out += fmt::format("  sensitivities of {} bands\n", part.metadata.sensitivities.size());
    if (part.metadata.camera_response)
        out += "  camera response\n";
    if (part.metadata.lens_transmission)
        out += "  lens transmission\n";
    if (part.metadata.handedness)
        out += "  polarisation handedness " + *part.metadata.handedness + "\n";
    if (!part.layout.others.empty()) {
        std::vector<std::string> names;
        for (const std::size_t channel : part.layout.others)
            names.push_back(part.layout.channel_names[channel]);
        const std::size_t count = names.size();
        names.resize(std::min(count, kNamedChannels));
        out += "  other channels: " + join(names, ", ") +
               (count > kNamedChannels ? fmt::format(" and {} more", count - kNamedChannels) : "") + " (" +
               types_text(part, part.layout.others, [](std::size_t c) { return c; }) + ")\n";
    }
    for (const auto* warnings : {&part.layout.warnings, &part.metadata.warnings})
        for (const std::string& warning : *warnings)
            out += "  warning: " + warning + "\n";
    return out;
}

std::string percent(double share) {
    return fmt::format("{:.3g} %", 100 * share);
}

}  // namespace

std::string spacing_text(const std::vector<double>& nm) {
    if (nm.size() < 2)
        return nm.empty() ? "no wavelength" : format_double(nm[0]) + " nm";
    double least = nm[1] - nm[0], most = least;
    for (std::size_t i = 1; i < nm.size(); ++i) {
        least = std::min(least, nm[i] - nm[i - 1]);
        most = std::max(most, nm[i] - nm[i - 1]);
    }
    const std::string range = format_double(nm.front()) + "-" + format_double(nm.back()) + " nm";
    if (most - least < kSameSpacingNm)
        return range + " every " +
               fmt::format("{:.6g} nm", (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1));
    return range + fmt::format(" spaced {:.6g} to {:.6g} nm", least, most);
}

std::string info_text(const image::SpectralImage& file) {
    std::string out =
        fmt::format("{}: {} part{}\n", file.path(), file.parts().size(), file.parts().size() == 1 ? "" : "s");
    for (std::size_t part = 0; part < file.parts().size(); ++part)
        out += part_text(file.parts()[part], part);
    return out;
}

std::string plan_text(const image::CollapseJob& job) {
    const CollapsePlan& plan = job.plan;
    std::string out = fmt::format("recipe       {}\nplan         {}\n", recipe_text(plan.request), plan.id);
    out += fmt::format("set          {} of part {}: {} bands, {}\n", plan.request.set, job.part_index,
                       plan.bands.size(), spacing_text(plan.wavelengths_nm()));
    out += fmt::format("observer     {}: {}\n", plan.observer.id, plan.observer.source);
    out += plan.illuminant
               ? fmt::format("illuminant   {}: {}\n", plan.illuminant->id, plan.illuminant->source)
               : std::string("illuminant   none: the bands are radiance\n");
    out += fmt::format("integral     {} basis, {}, extrapolate {}\n", basis_name(plan.basis.basis),
                       plan.quadrature == Quadrature::Sum1nm
                           ? "CIE 15 sum at 1 nm over 360-830 nm"
                           : "exact integral over 360-830 nm (bands closer than 1 nm)",
                       extrapolation_name(plan.request.extrapolation));
    out += fmt::format("basis        {}: {}\n", basis_name(plan.basis.basis), plan.basis.reason);
    for (const BasisSpread& spread : basis_spread(plan))
        out += fmt::format("  if {:<14} {:.2f} dE2000 mean, {:.2f} max, over the ColorChecker\n",
                           basis_name(spread.basis), spread.residual.mean, spread.residual.max);
    if (plan.reradiation)
        out += fmt::format(
            "reradiation  {} pairs, excited at {}, emitted at {}: elements of a Donaldson matrix\n",
            plan.columns.size() - plan.bands.size(), spacing_text(plan.reradiation->excited_nm),
            spacing_text(plan.reradiation->emitted_nm));
    for (const Filter& filter : plan.filters)
        out += fmt::format("filter       {}\n", filter.path);
    if (plan.display)
        out += fmt::format("display      {}\n", plan.display->path);
    if (plan.request.scale != Scale::Relative)
        out += fmt::format("scale        {}\n", scale_name(plan.request.scale));
    if (plan.adapted_from) {
        const Vector3& white = *plan.adapted_from;
        out += fmt::format("adaptation   {} from XYZ {:.6f} {:.6f} {:.6f}\n",
                           adaptation_name(plan.request.adaptation), white[0], white[1], white[2]);
    }
    if (plan.space.transform) {
        const TransformSource& source = plan.space.transform->source();
        out += fmt::format("config       {} ({}), {}\n", source.config_name, source.config_file,
                           source.config_id);
        out += fmt::format("transform    {} to {}, processor {}{}\n", source.from, plan.space.id,
                           source.processor, plan.space.transform->is_linear() ? ", linear" : "");
    }
    const std::vector<std::string> weighed = plan.weighed();
    out += "extrapolated";
    for (std::size_t row = 0; row < weighed.size(); ++row)
        out += fmt::format(" {} {}", weighed[row], percent(plan.extrapolated_share[row]));
    out += " of each output's weight\n";

    std::vector<TextTable::Column> columns{{"channel"}, {"nm", TextTable::Align::Right}};
    for (const std::string& output : weighed)
        columns.push_back({output, TextTable::Align::Right});
    TextTable table(columns);
    for (std::size_t i = 0; i < plan.columns.size(); ++i) {
        const PlanColumn& column = plan.columns[i];
        if (column.emitted_nm)
            continue;
        std::vector<std::string> row{job.part().layout.channel_names[column.channel],
                                     format_double(column.wavelength_nm)};
        for (std::size_t output = 0; output < weighed.size(); ++output)
            row.push_back(fmt::format("{:.9f}", plan.weights.at(output, i)));
        table.add(std::move(row));
    }
    if (plan.reradiation) {
        std::vector<std::string> row{fmt::format("{} pairs, sum", plan.columns.size() - plan.bands.size()),
                                     ""};
        for (std::size_t output = 0; output < weighed.size(); ++output) {
            const auto weights = plan.weights.row(output).subspan(plan.bands.size());
            row.push_back(fmt::format("{:.9f}", std::accumulate(weights.begin(), weights.end(), 0.0)));
        }
        table.add(std::move(row));
    }
    out += "\n" + table.text();
    for (const std::string& warning : job.warnings)
        out += "warning: " + warning + "\n";
    return out;
}

std::string convert_text(const ConvertReport& report) {
    const convert::Outcome& outcome = report.outcome;
    std::string out =
        fmt::format("{}: {}x{} {}, {} bands, {:.2f} s\n", outcome.output, outcome.width, outcome.height,
                    join(outcome.types, " and "), outcome.bands, report.seconds);
    if (outcome.outputs.size() > 1)
        out += fmt::format("{} files, {} to {}\n", outcome.outputs.size(), outcome.outputs.front(),
                           outcome.outputs.back());
    else if (!outcome.data.empty())
        out += fmt::format("data in {}\n", outcome.data);
    for (const std::string& what : outcome.lost)
        out += fmt::format("note: not in the output: {}\n", what);
    if (outcome.clamped_samples > 0)
        out +=
            fmt::format("note: {} samples beyond +-65504 were written as +-65504\n", outcome.clamped_samples);
    if (outcome.clipped_samples > 0)
        out += fmt::format("note: {} samples were clipped to 0 to 1\n", outcome.clipped_samples);
    return out;
}

std::string bake_text(const BakedMatrix& baked) {
    std::string out;
    for (const std::string& line : baked.description())
        out += line + "\n";
    for (const Vector3& row : baked.matrix.rows)
        out += fmt::format("{:13.9f} {:13.9f} {:13.9f}\n", row[0], row[1], row[2]);
    return out;
}

std::string outcome_text(const image::CollapseJob& job, const CollapseOutcome& outcome) {
    const CollapsePlan& plan = job.plan;
    std::string out = fmt::format(
        "{}: {}x{} {} {}, from {} bands{} of set {}{} ({}), plan {}, {:.2f} s\n", outcome.output,
        job.part().data_window.width(), job.part().data_window.height(), plan.space.id, outcome.type,
        plan.bands.size(),
        plan.reradiation ? fmt::format(" and {} pairs", plan.columns.size() - plan.bands.size()) : "",
        plan.request.set, plan.illuminant ? " under " + plan.illuminant->id : "", plan.observer.id, plan.id,
        outcome.seconds);
    const auto line = [&out, &outcome](std::uint64_t count, std::string_view what) {
        if (count > 0)
            out += fmt::format("note: {} of {} pixels {}\n", count, outcome.counts.pixels, what);
    };
    line(outcome.counts.nan, "hold NaN");
    line(outcome.counts.infinite, "are infinite");
    line(outcome.counts.negative, "have a negative channel, outside the gamut");
    line(outcome.counts.polarisation.undefined,
         plan.space.kind == SpaceKind::AoLP ? "have no linear polarisation, so no angle: 0 was written"
                                            : "have no light, so no degree: 0 was written");
    line(outcome.counts.polarisation.beyond, "are polarised by more than 1, as no light is");
    line(outcome.clipped_pixels, "were clipped to 0 to 1");
    if (outcome.clamped_samples > 0)
        out +=
            fmt::format("note: {} samples beyond +-65504 were written as +-65504\n", outcome.clamped_samples);
    return out;
}

}  // namespace osio::tool
