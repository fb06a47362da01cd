// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/report_reduce.h>
#include <tools/osiotool/text_table.h>

#include <osio/base/text.h>

#include <fmt/format.h>

namespace osio::tool {

namespace {

constexpr double kMega = 1e6;

std::string bands_text(const reduce::Reduction& reduction) {
    if (reduction.coefficients > 0)
        return fmt::format("{} coefficients as {}, which only this project reads,", reduction.coefficients,
                           reduction.samples);
    if (reduction.edges_nm.empty())
        return fmt::format("all {} bands as {}", reduction.wavelengths_nm.size(), reduction.samples);
    std::vector<std::string> edges;
    for (const double nm : reduction.edges_nm)
        edges.push_back(format_double(nm));
    return fmt::format("{} bins as {}, edges {} nm", reduction.wavelengths_nm.size(), reduction.samples,
                       join(edges, " "));
}

std::string demands_table(const reduce::Reduction& reduction) {
    TextTable table({{"light"},
                     {"observer"},
                     {"dE mean", TextTable::Align::Right},
                     {"dE max", TextTable::Align::Right},
                     {"at", TextTable::Align::Right},
                     {"without colour", TextTable::Align::Right}});
    for (const reduce::DemandResult& demand : reduction.demands)
        table.add({demand.light.empty() ? "(radiance)" : demand.light, demand.observer,
                   fmt::format("{:.4f}", demand.mean), fmt::format("{:.4f}", demand.largest),
                   fmt::format("{},{}", demand.largest_at[0], demand.largest_at[1]),
                   std::to_string(demand.undefined)});
    return table.text();
}

std::string exclusions_text(const reduce::Reduction& reduction) {
    std::vector<std::string> names;
    for (const reduce::OtherResult& other : reduction.others)
        if (!(other.largest <= reduction.tolerance))
            names.push_back(fmt::format("{} ({:.2f})", other.light.empty() ? other.observer : other.light,
                                        other.largest));
    const std::string verified = "verified for the demands above and no others";
    if (names.empty())
        return verified +
               fmt::format("; of {} others none exceeds it on {} sampled pixels, which proves nothing\n",
                           reduction.others.size(), reduction.sampled_pixels);
    return verified + "\nmust not be used under " + join(names, ", ") +
           fmt::format(": largest CIEDE2000 of {} sampled pixels\n", reduction.sampled_pixels);
}

}  // namespace

std::string reduce_text(const reduce::Outcome& outcome, double seconds) {
    const reduce::Reduction& reduction = outcome.reduction;
    std::string out = fmt::format("{}: {} of {} bands of set {}\n", outcome.output, bands_text(reduction),
                                  reduction.source_bands, reduction.set);
    out +=
        fmt::format("{:.2f} MB ({}) of {:.2f} MB: {:.1f} times smaller; {}x{} pixels, {} pass{}, {:.2f} s\n",
                    static_cast<double>(outcome.bytes) / kMega, reduction.compression,
                    static_cast<double>(reduction.source_bytes) / kMega,
                    static_cast<double>(reduction.source_bytes) / static_cast<double>(outcome.bytes),
                    outcome.width, outcome.height, outcome.passes, outcome.passes > 1 ? "es" : "", seconds);
    out += fmt::format("every pixel within CIEDE2000 {} as stored; white: Y = {:.6g}, {}\n",
                       format_double(reduction.tolerance), reduction.white_luminance, reduction.white_reason);
    out += demands_table(reduction);
    out += exclusions_text(reduction);
    if (!reduction.edges_nm.empty() || reduction.coefficients > 0)
        out += fmt::format("spectra of sampled pixels are off by {:.2g} (RMS), {:.2g} at most\n",
                           reduction.spectrum_rms, reduction.spectrum_largest);
    if (reduction.changed_pixels > 0)
        out += fmt::format(
            "{} pixels would be below zero in some band: the nearest samples that are not are stored\n",
            reduction.changed_pixels);
    if (reduction.negative_samples > 0)
        out += fmt::format("{} samples are below zero{}\n", reduction.negative_samples,
                           reduction.coefficients > 0 ? "" : ", in pixels where the original has some");
    if (reduction.clamped_samples > 0)
        out += fmt::format("{} samples were beyond +-65504 and are that now\n", reduction.clamped_samples);
    for (const std::string& lost : reduction.lost)
        out += fmt::format("lost: {}\n", lost);
    return out;
}

}  // namespace osio::tool
