// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/audit.h>
#include <tools/osiotool/report.h>

#include <formats/image/header_attributes.h>

#include <fmt/format.h>

#include <algorithm>

namespace osio::tool {

namespace {

WrittenPart written_part(const image::Part& part) {
    WrittenPart out{part.layout, part.metadata, image::header_attributes(part.header), {}, false, 1};
    for (auto a = part.header.begin(); a != part.header.end(); ++a)
        out.attributes.insert(a.name());
    for (const SpectralSet& set : part.layout.sets)
        for (const Band& band : set.bands) {
            out.half_bands = out.half_bands || part.channels[band.channel].type == SampleType::Half;
            out.scale = part.channels[band.channel].scale;
        }
    return out;
}

std::vector<std::string> problems_of(const image::Part& part) {
    std::vector<std::string> out;
    for (const auto* warnings : {&part.layout.warnings, &part.metadata.warnings})
        out.insert(out.end(), warnings->begin(), warnings->end());
    if (part.deep)
        out.emplace_back("is deep, several samples a pixel: flatten it first");
    std::size_t subsampled = 0;
    for (const SpectralSet& set : part.layout.sets)
        subsampled += static_cast<std::size_t>(
            std::count_if(set.bands.begin(), set.bands.end(),
                          [&part](const Band& band) { return part.channels[band.channel].subsampled; }));
    if (subsampled > 0)
        out.push_back(
            fmt::format("{} bands are sub-sampled: every band needs a sample at every pixel", subsampled));
    return out;
}

std::string part_text(const AuditedPart& part, std::size_t index) {
    std::string out = fmt::format("part {}{}: ", index, part.name.empty() ? "" : " \"" + part.name + "\"");
    out += part.writer.name.empty()
               ? "its header does not tell who wrote it\n"
               : fmt::format("written by {} ({})\n", part.writer.name, part.writer.evidence);
    if (!part.dialect.name.empty())
        out += fmt::format("  dialect: {}, {}\n", part.dialect.name, part.dialect.evidence);
    if (part.sets.empty())
        out += "  no spectral bands\n";
    for (const AuditedSet& set : part.sets)
        out += fmt::format("  set {}: {}, {} bands, {}; basis {}: {}\n", set.name,
                           quantity_name(set.quantity), set.wavelengths_nm.size(),
                           spacing_text(set.wavelengths_nm), basis_name(set.basis.basis), set.basis.reason);
    for (const std::string& what : part.assumed)
        out += "  assumed: " + what + "\n";
    for (const Quirk& quirk : part.quirks)
        out += "  quirk: " + quirk.what + "; " + quirk.done + "\n";
    for (const std::string& problem : part.problems)
        out += "  problem: " + problem + "\n";
    return out;
}

}  // namespace

AuditedPart audit_part(const image::Part& part) {
    const WrittenPart written = written_part(part);
    AuditedPart out{part.name,
                    find_writer(written),
                    part.layout.dialect,
                    {},
                    find_assumptions(written),
                    find_quirks(written),
                    problems_of(part)};
    for (const SpectralSet& set : part.layout.sets) {
        if (set.bands.empty())
            continue;
        const BandGrid grid = distinct_bands(set, part.metadata).grid;
        auto basis = choose_basis(Basis::Auto, set, grid, part.metadata);
        out.sets.push_back(
            {set.name(), set.quantity(), set.wavelengths_nm(), basis ? std::move(*basis) : BasisChoice()});
    }
    return out;
}

std::string audit_text(const AuditedFile& file) {
    if (file.failure)
        return fmt::format("{}: {}\n", file.path, file.failure->what);
    std::string out = fmt::format("{}: {}\n", file.path, file.format);
    for (std::size_t i = 0; i < file.parts.size(); ++i)
        out += part_text(file.parts[i], i);
    return out;
}

}  // namespace osio::tool
