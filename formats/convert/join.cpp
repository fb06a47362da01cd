// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/choice.h>
#include <formats/convert/join.h>
#include <formats/convert/joined_rows.h>
#include <formats/image/derived_image.h>
#include <formats/image/header_attributes.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <map>

namespace osio::convert {

namespace {

using Images = std::span<const std::shared_ptr<const image::SpectralImage>>;

/// A part of one of the images.
struct Member {
    std::shared_ptr<const image::SpectralImage> image;
    std::size_t part = 0;

    [[nodiscard]] const image::Part& header() const { return image->parts()[part]; }

    [[nodiscard]] std::string name() const {
        return image->parts().size() == 1 ? image->path() : image->path() + ", part " + std::to_string(part);
    }
};

/// Where a channel of the joined image comes from.
struct Origin {
    std::size_t member = 0;
    std::size_t channel = 0;
};

class JoinedImage final : public image::SpectralImage {
  public:
    JoinedImage(std::vector<Member> members, std::vector<Origin> origins, image::Part part)
        : SpectralImage(members.front().image->path()), m_members(std::move(members)),
          m_origins(std::move(origins)) {
        add(std::move(part));
    }

    [[nodiscard]] std::string_view format() const override { return m_members.front().image->format(); }

    [[nodiscard]] Result<std::unique_ptr<BlockSource>>
    make_block_source(std::size_t, image::PlaneChannels wanted, image::Grain grain) const override {
        std::vector<image::PlaneChannels> read(m_members.size());
        std::vector<JoinedPlane> planes;
        for (const auto& channel : wanted) {
            if (!channel)
                return fail(ErrorCode::Unsupported, "a joined image gives every plane", path());
            const Origin& origin = m_origins[*channel];
            planes.push_back({origin.member, read[origin.member].size()});
            read[origin.member].emplace_back(origin.channel);
        }
        std::vector<std::unique_ptr<BlockSource>> sources;
        std::vector<std::size_t> place(m_members.size());
        for (std::size_t m = 0; m < m_members.size(); ++m) {
            if (read[m].empty())
                continue;
            place[m] = sources.size();
            OSIO_TRY(auto source, m_members[m].image->make_block_source(m_members[m].part, read[m], grain));
            sources.push_back(std::move(source));
        }
        for (JoinedPlane& plane : planes)
            plane.source = place[plane.source];
        return join_sources(std::move(sources), std::move(planes));
    }

  private:
    std::vector<Member> m_members;
    std::vector<Origin> m_origins;
};

std::string window_text(const image::Window& window) {
    return std::to_string(window.width()) + "x" + std::to_string(window.height()) + " pixels from " +
           std::to_string(window.min_x) + "," + std::to_string(window.min_y);
}

/// The parts that are joined.
Result<std::vector<Member>> members_of(Images images, const std::string& part,
                                       std::vector<std::string>& lost) {
    std::vector<Member> out;
    for (const auto& image : images) {
        std::size_t first = 0, end = image->parts().size();
        if (!part.empty()) {
            auto chosen = select_part(image->summaries(), part);
            if (!chosen)
                return fail_in(image->path(), std::move(chosen).error());
            first = *chosen, end = first + 1;
        }
        const std::size_t before = out.size();
        for (; first < end; ++first) {
            const Member member{image, first};
            const image::Part& header = member.header();
            if (!header.deep && !header.layout.sets.empty())
                out.push_back(member);
            else
                lost.push_back("part " + std::to_string(first) + " of " + image->path() +
                               (header.deep ? ", which is deep" : ", which has no bands"));
        }
        // The refusal in the words of a file that is opened alone.
        if (out.size() == before) {
            CollapseRequest words;
            words.part = part;
            OSIO_TRY(const Selection none, image->select(words));
            static_cast<void>(none);
        }
    }
    const image::Part& first = out.front().header();
    for (const Member& member : out)
        if (const image::Part& header = member.header(); header.data_window != first.data_window)
            return fail(ErrorCode::Unsupported,
                        "has " + window_text(header.data_window) + ", and " + out.front().name() + " has " +
                            window_text(first.data_window) + "; images of one size are joined",
                        member.name());
    return out;
}

std::string bytes_of(const Imf::Attribute& attribute) {
    class Bytes final : public Imf::OStream {
      public:
        Bytes() : Imf::OStream("") {}

        void write(const char bytes[], int count) override {
            m_text.append(bytes, static_cast<std::size_t>(count));
        }

        std::uint64_t tellp() override { return m_text.size(); }

        void seekp(std::uint64_t) override {}

        [[nodiscard]] const std::string& text() const { return m_text; }

      private:
        std::string m_text;
    } bytes;

    attribute.writeValueTo(bytes, Imf::EXR_VERSION);
    return attribute.typeName() + (':' + bytes.text());
}

/// "450nm:10;550nm:12;" of all members, where all say widths.
std::optional<std::string> joined_widths(const std::vector<Member>& members) {
    std::string out;
    for (const Member& member : members) {
        const auto& widths = member.header().metadata.fwhm;
        if (!widths)
            return std::nullopt;
        for (const SpectralSet& set : member.header().layout.sets)
            for (const Band& band : set.bands)
                out += format_double(band.wavelength_nm) +
                       "nm:" + format_double(widths->held_at(band.wavelength_nm)) + ";";
    }
    return out;
}

Imf::Header joined_attributes(const std::vector<Member>& members, std::vector<std::string>& lost) {
    Imf::Header out = attributes_of(members.front().header());
    std::map<std::string, std::vector<std::string>> conflicts;
    bool widths = false, edges = false;
    for (const Member& member : members) {
        const Imf::Header own = attributes_of(member.header());
        for (auto a = own.begin(); a != own.end(); ++a) {
            const std::string name = a.name();
            widths = widths || name == attribute::kFwhm;
            edges = edges || name == attribute::kBinEdges;
            const auto found = out.find(name);
            if (found == out.end())
                out.insert(name, a.attribute());
            else if (name != attribute::kFwhm && name != attribute::kBinEdges && name != "dataWindow" &&
                     name != "channels" && bytes_of(found.attribute()) != bytes_of(a.attribute()))
                conflicts[member.name()].push_back(name);
        }
    }
    if (members.size() > 1 && widths) {
        image::erase_attributes({std::string(attribute::kFwhm)}, out);
        if (const auto text = joined_widths(members))
            out.insert(std::string(attribute::kFwhm), Imf::StringAttribute(*text));
        else
            lost.push_back(std::string(attribute::kFwhm) + ", which not all files have");
    }
    if (members.size() > 1 && edges) {
        image::erase_attributes({std::string(attribute::kBinEdges)}, out);
        lost.push_back(std::string(attribute::kBinEdges) + ", which count the bands of one file");
    }
    for (const auto& [file, names] : conflicts)
        lost.push_back((names.size() > 1 ? "attributes " : "attribute ") + names_text(names) + " of " + file +
                       ", where the first file says something else");
    return out;
}

}  // namespace

Result<Joined> join_images(Images images, const std::string& part) {
    Joined out;
    OSIO_TRY(auto members, members_of(images, part, out.lost));
    std::vector<Origin> origins;
    std::vector<image::Channel> channels;
    std::map<std::string, std::size_t> taken;  // a band's or channel's name, and the member that has it
    for (std::size_t m = 0; m < members.size(); ++m) {
        const image::Part& header = members[m].header();
        const std::vector<std::string> own = image::derived_names(header);
        std::vector<std::string> hidden;
        for (std::size_t c = 0; c < header.channels.size(); ++c) {
            const std::string& name = own[c];
            const auto band = parse_channel_name(name, DecimalMark::Comma);
            const auto [found, is_new] =
                taken.emplace(band ? format_channel_name(*band, DecimalMark::Comma) : name, m);
            // Bands of one wavelength in one file are that file's own business.
            if (!is_new && band && found->second != m)
                return fail(ErrorCode::Usage,
                            "band " + name + " is in " + members[found->second].name() + " too",
                            members[m].name());
            if (!is_new && !band) {
                hidden.push_back(name);
                continue;
            }
            origins.push_back({m, c});
            channels.push_back(header.channels[c]);
            channels.back().name = name;
        }
        if (!hidden.empty())
            out.lost.push_back((hidden.size() > 1 ? "channels " : "channel ") + names_text(hidden) + " of " +
                               members[m].name());
    }
    image::Part whole = image::described_part(std::move(channels), joined_attributes(members, out.lost));
    // What was said when the files were read is still worth saying; sets and names are described anew.
    for (const Member& member : members)
        add_unique(member.header().layout.warnings, whole.layout.warnings);
    out.image = std::make_shared<JoinedImage>(std::move(members), std::move(origins), std::move(whole));
    return out;
}

}  // namespace osio::convert
