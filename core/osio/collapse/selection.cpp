// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/selection.h>

#include <algorithm>

namespace osio {

namespace {

/// Names of at most this many channels are listed in an error.
constexpr std::size_t kChannelsInError = 6;

std::string part_label(std::span<const PartSummary> parts, std::size_t part) {
    std::string out = "part " + std::to_string(part);
    if (!parts[part].name.empty())
        out += " \"" + parts[part].name + "\"";
    return out;
}

std::string list_parts(std::span<const PartSummary> parts) {
    std::vector<std::string> labels;
    for (std::size_t part = 0; part < parts.size(); ++part)
        labels.push_back(part_label(parts, part));
    return join(labels, ", ");
}

std::string list_sets(std::span<const PartSummary> parts, std::span<const Selection> selections) {
    std::vector<std::string> labels;
    for (const Selection& s : selections) {
        std::string label = parts[s.part].layout->sets[s.set].name();
        if (parts.size() > 1)
            label += " in " + part_label(parts, s.part);
        labels.push_back(std::move(label));
    }
    return join(labels, ", ");
}

tl::unexpected<Error> not_spectral(std::span<const PartSummary> parts, std::span<const std::size_t> chosen) {
    std::vector<std::string> names;
    for (const std::size_t part : chosen) {
        const ChannelLayout& layout = *parts[part].layout;
        if (!layout.dialect.name.empty())
            return fail(ErrorCode::NotSpectral, without_wavelengths(layout.dialect));
        names.insert(names.end(), layout.channel_names.begin(), layout.channel_names.end());
    }
    const std::size_t count = names.size();
    names.resize(std::min(count, kChannelsInError));
    return fail(
        ErrorCode::NotSpectral,
        "no spectral band among " + std::to_string(count) + " channels (" + join(names, ", ") +
            (count > kChannelsInError ? ", ..." : "") +
            "); expected channels of the spectral EXR layout such as T.450nm or S0.450nm, of a dialect "
            "that is read, or wavelengths= that says what they are");
}

/// The sets that a polarimetric space may be made of: the first component of each root.
std::vector<Selection> with_stokes(std::span<const PartSummary> parts, std::span<const Selection> all) {
    std::vector<Selection> out;
    for (const Selection& s : all) {
        const SpectralSet& set = parts[s.part].layout->sets[s.set];
        const bool known = std::any_of(out.begin(), out.end(), [&](const Selection& other) {
            return other.part == s.part && parts[other.part].layout->sets[other.set].root == set.root;
        });
        if (set.family != Family::T && !known)
            out.push_back(s);
    }
    return out;
}

bool stands_back(const SpectralSet& set) {
    return set.family == Family::S1 || set.family == Family::S2 || set.family == Family::S3;
}

Result<void> check_samples(std::span<const PartSummary> parts, const Selection& selection) {
    const PartSummary& part = parts[selection.part];
    if (part.deep)
        return fail(ErrorCode::Unsupported, part_label(parts, selection.part) +
                                                " is deep (several samples a pixel); flatten it first");
    const SpectralSet& set = part.layout->sets[selection.set];
    const auto check = [&](std::size_t channel) -> Result<void> {
        if (!part.subsampled[channel])
            return {};
        return fail(ErrorCode::Unsupported,
                    "band \"" + part.layout->channel_names[channel] +
                        "\" is sub-sampled; every band needs a sample at every pixel");
    };
    for (const Band& band : set.bands)
        OSIO_CHECK_OK(check(band.channel));
    for (const Reradiation& pair : set.reradiation)
        OSIO_CHECK_OK(check(pair.channel));
    return {};
}

}  // namespace

Result<std::size_t> select_part(std::span<const PartSummary> parts, const std::string& part) {
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].name == part)
            return i;
    if (const auto index = parse_int(part))
        if (*index >= 0 && static_cast<std::size_t>(*index) < parts.size())
            return static_cast<std::size_t>(*index);
    return fail(ErrorCode::NoSuchPart,
                "there is no part \"" + part + "\"; the file has " + list_parts(parts));
}

Result<Selection> select_set(std::span<const PartSummary> parts, const CollapseRequest& request) {
    std::vector<std::size_t> chosen;
    if (request.part.empty()) {
        for (std::size_t part = 0; part < parts.size(); ++part)
            chosen.push_back(part);
    } else {
        OSIO_TRY(const std::size_t part, select_part(parts, request.part));
        chosen.push_back(part);
    }

    std::vector<Selection> all;
    for (const std::size_t part : chosen)
        for (std::size_t set = 0; set < parts[part].layout->sets.size(); ++set)
            all.push_back({part, set});
    if (all.empty())
        return not_spectral(parts, chosen);

    const auto set_of = [&](const Selection& s) -> const SpectralSet& {
        return parts[s.part].layout->sets[s.set];
    };
    std::vector<Selection> fitting;
    std::copy_if(all.begin(), all.end(), std::back_inserter(fitting), [&](const Selection& s) {
        return request.set.empty() ? !stands_back(set_of(s)) : set_of(s).name() == request.set;
    });
    if (fitting.empty() && request.set.empty())
        fitting = all;
    if (request.set.empty() && request.to && is_polarimetric(request.to->kind))
        fitting = with_stokes(parts, all);
    if (fitting.empty() && request.set.empty())
        return fail(ErrorCode::NoSuchPart, "to=" + request.to->id +
                                               " is made of Stokes components, and there is none; found " +
                                               list_sets(parts, all));
    if (fitting.empty())
        return fail(ErrorCode::NoSuchPart,
                    "there is no set \"" + request.set + "\"; found " + list_sets(parts, all));
    if (fitting.size() > 1)
        return fail(ErrorCode::Ambiguous, "several sets of bands fit: " + list_sets(parts, fitting) +
                                              "; name one with set=... or part=...");
    OSIO_CHECK_OK(check_samples(parts, fitting.front()));
    return fitting.front();
}

}  // namespace osio
