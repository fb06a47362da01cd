// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/choice.h>
#include <formats/exr/output_header.h>
#include <formats/image/header_attributes.h>
#include <formats/image/preview_plan.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <set>

namespace osio::convert {

namespace {

constexpr std::size_t kNamed = 12;

/// Bin edges of the bands that stay: bands i to j have the edges i to j + 1.
void cut_bin_edges(const image::Part& part, const SpectralSet& whole, const SpectralSet& kept, Choice& out) {
    const std::string name(attribute::kBinEdges);
    if (out.attributes.find(name) == out.attributes.end())
        return;
    const auto& edges = part.metadata.bin_edges_nm;
    if (edges.size() != whole.bands.size() + 1) {
        image::erase_attributes({name}, out.attributes);
        out.lost.push_back(name + ", which do not fit the bands");
        return;
    }
    const auto first = std::find_if(whole.bands.begin(), whole.bands.end(), [&](const Band& band) {
        return band.channel == kept.bands.front().channel;
    });
    std::vector<std::string> words;
    for (std::size_t i = 0; i <= kept.bands.size(); ++i)
        words.push_back(format_double(edges[static_cast<std::size_t>(first - whole.bands.begin()) + i]));
    out.attributes.insert(name, Imf::StringAttribute(join(words, ";")));
}

}  // namespace

Imf::Header attributes_of(const image::Part& part) {
    Imf::Header out(part.header.displayWindow(), part.header.dataWindow());
    for (auto a = part.header.begin(); a != part.header.end(); ++a)
        if (!exr::is_structural(a.name()) && !names_a_band(part.layout.dialect, a.name()))
            out.insert(a.name(), a.attribute());
    out.compression() = Imf::ZIP_COMPRESSION;
    return out;
}

std::vector<std::string> picture_names(const std::string& root) {
    std::vector<std::string> out;
    for (const char* name : {"R", "G", "B"})
        out.push_back(root.empty() ? name : root + "." + name);
    return out;
}

void add_unique(std::vector<std::string> from, std::vector<std::string>& to) {
    for (std::string& text : from)
        if (std::find(to.begin(), to.end(), text) == to.end())
            to.push_back(std::move(text));
}

std::string names_text(const std::vector<std::string>& names) {
    std::vector<std::string> shown(
        names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kNamed)));
    return join(shown, ", ") + (names.size() > kNamed
                                    ? " and " + std::to_string(names.size() - kNamed) + " more"
                                    : std::string());
}

Choice choose(std::shared_ptr<const image::SpectralImage> image, const Selection& selection,
              bool everything) {
    Choice out;
    out.image = std::move(image);
    out.part_index = selection.part;
    out.set = out.part().layout.sets[selection.set];
    out.attributes = attributes_of(out.part());
    if (everything)
        for (std::size_t channel = 0; channel < out.part().channels.size(); ++channel)
            out.channels.push_back(channel);
    else
        for (const Band& band : out.set.bands)
            out.channels.push_back(band.channel);
    return out;
}

Result<void> leave_out(const std::function<bool(double nm)>& keep, const std::string& wanted,
                       Choice& choice) {
    const ChannelLayout& layout = choice.part().layout;
    std::set<std::size_t> left_out;
    std::vector<std::string> pictures;
    for (const SpectralSet& set : layout.sets) {
        const std::size_t before = left_out.size();
        for (const Band& band : set.bands)
            if (!keep(band.wavelength_nm))
                left_out.insert(band.channel);
        for (const Reradiation& pair : set.reradiation)
            if (!keep(pair.excited_nm) || !keep(pair.emitted_nm))
                left_out.insert(pair.channel);
        if (left_out.size() != before)
            add_unique(picture_names(set.root), pictures);
    }
    const SpectralSet whole = choice.set;
    std::erase_if(choice.set.bands, [&](const Band& band) { return left_out.contains(band.channel); });
    if (choice.set.bands.empty())
        return fail(ErrorCode::Unsupported,
                    "no band of set " + whole.name() + " lies in " + wanted + "; it has " +
                        format_double(whole.bands.front().wavelength_nm) + "-" +
                        format_double(whole.bands.back().wavelength_nm) + " nm",
                    choice.image->path());
    if (left_out.empty())
        return {};
    cut_bin_edges(choice.part(), whole, choice.set, choice);
    for (const std::string& name : pictures)
        if (const auto channel = layout.find_channel(name)) {
            left_out.insert(*channel);
            choice.lost.push_back("channel " + name + ", a preview of all bands");
        }
    image::erase_attributes({image::attribute::kPreviewRecipe, std::string(attribute::kReduction)},
                            choice.attributes);
    std::erase_if(choice.channels, [&](std::size_t channel) { return left_out.contains(channel); });
    choice.spoken_of.insert(left_out.begin(), left_out.end());
    return {};
}

void leave_out_other_sets(Choice& choice) {
    std::set<std::size_t> left_out;
    for (const SpectralSet& set : choice.part().layout.sets) {
        if (set.name() == choice.set.name())
            continue;
        for (const Band& band : set.bands)
            left_out.insert(band.channel);
        for (const Reradiation& pair : set.reradiation)
            left_out.insert(pair.channel);
    }
    std::erase_if(choice.channels, [&](std::size_t channel) { return left_out.contains(channel); });
    choice.spoken_of.insert(left_out.begin(), left_out.end());
}

void note_lost_channels(Choice& choice) {
    const auto& channels = choice.part().channels;
    std::vector<std::string> others;
    for (std::size_t channel = 0; channel < channels.size(); ++channel)
        if (!choice.spoken_of.contains(channel) &&
            std::find(choice.channels.begin(), choice.channels.end(), channel) == choice.channels.end())
            others.push_back(channels[channel].name);
    if (!others.empty())
        choice.lost.push_back((others.size() > 1 ? "channels " : "channel ") + names_text(others));
}

}  // namespace osio::convert
