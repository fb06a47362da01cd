// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/choice.h>
#include <formats/exr/output_header.h>
#include <formats/image/open_image.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <set>

namespace osio::convert {

namespace {

constexpr std::size_t kNamed = 12;

bool inside(const Range& range, double nm) {
    return nm >= range.first_nm && nm <= range.last_nm;
}

/// The part's attributes without its structure.
Imf::Header attributes_of(const image::Part& part) {
    Imf::Header out(part.header.displayWindow(), part.header.dataWindow());
    for (auto a = part.header.begin(); a != part.header.end(); ++a)
        if (!exr::is_structural(a.name()) && !names_a_band(part.layout.dialect, a.name()))
            out.insert(a.name(), a.attribute());
    out.compression() = Imf::ZIP_COMPRESSION;
    return out;
}

/// Bin edges of the bands that stay: bands i to j have the edges i to j + 1.
void cut_bin_edges(const image::Part& part, const SpectralSet& whole, const SpectralSet& kept, Choice& out) {
    const std::string name(attribute::kBinEdges);
    if (out.attributes.find(name) == out.attributes.end())
        return;
    const auto& edges = part.metadata.bin_edges_nm;
    if (edges.size() != whole.bands.size() + 1) {
        out.attributes.erase(name);
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

/// Leaves out the bands of every set that are not in range, and a preview that showed them.
Result<std::set<std::size_t>> outside(const Range& range, Choice& out) {
    const image::Part& part = out.part();
    std::set<std::size_t> left_out;
    for (const SpectralSet& set : part.layout.sets) {
        for (const Band& band : set.bands)
            if (!inside(range, band.wavelength_nm))
                left_out.insert(band.channel);
        for (const Reradiation& pair : set.reradiation)
            if (!inside(range, pair.excited_nm) || !inside(range, pair.emitted_nm))
                left_out.insert(pair.channel);
    }
    const SpectralSet whole = out.set;
    std::erase_if(out.set.bands, [&](const Band& band) { return left_out.contains(band.channel); });
    if (out.set.bands.empty())
        return fail(ErrorCode::Unsupported,
                    "no band of set " + whole.name() + " lies in " + format_double(range.first_nm) + "-" +
                        format_double(range.last_nm) + " nm; it has " +
                        format_double(whole.bands.front().wavelength_nm) + "-" +
                        format_double(whole.bands.back().wavelength_nm) + " nm",
                    out.image->path());
    if (left_out.empty())
        return left_out;
    cut_bin_edges(part, whole, out.set, out);
    for (const char* name : {"R", "G", "B"})
        if (const auto channel = part.layout.find_channel(name)) {
            left_out.insert(*channel);
            out.lost.push_back(std::string("channel ") + name + ", a preview of all bands");
        }
    return left_out;
}

}  // namespace

std::string names_text(const std::vector<std::string>& names) {
    std::vector<std::string> shown(
        names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kNamed)));
    return join(shown, ", ") + (names.size() > kNamed
                                    ? " and " + std::to_string(names.size() - kNamed) + " more"
                                    : std::string());
}

Result<Choice> choose(const Request& request, bool everything) {
    Choice out;
    OSIO_TRY(out.image, image::open_image(request.input, request.words));
    CollapseRequest words;
    words.part = request.part;
    words.set = request.set;
    OSIO_TRY(const Selection selection, out.image->select(words));
    out.part_index = selection.part;
    out.set = out.part().layout.sets[selection.set];
    if (out.set.bands.empty())
        return fail(ErrorCode::Unsupported, "set " + out.set.name() + " has reradiation only",
                    out.image->path());
    out.attributes = attributes_of(out.part());
    if (const std::size_t parts = out.image->parts().size(); parts > 1)
        out.lost.push_back(std::to_string(parts - 1) + " other part" + (parts > 2 ? "s" : ""));
    std::set<std::size_t> left_out;
    if (request.bands) {
        OSIO_TRY(left_out, outside(*request.bands, out));
    }
    const auto& channels = out.part().channels;
    if (everything) {
        for (std::size_t channel = 0; channel < channels.size(); ++channel)
            if (!left_out.contains(channel))
                out.channels.push_back(channel);
        return out;
    }
    for (const Band& band : out.set.bands)
        out.channels.push_back(band.channel);
    std::vector<std::string> others;
    for (std::size_t channel = 0; channel < channels.size(); ++channel)
        if (!left_out.contains(channel) &&
            std::find(out.channels.begin(), out.channels.end(), channel) == out.channels.end())
            others.push_back(channels[channel].name);
    if (!others.empty())
        out.lost.push_back((others.size() > 1 ? "channels " : "channel ") + names_text(others));
    return out;
}

}  // namespace osio::convert
