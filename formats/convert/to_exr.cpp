// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/samples.h>
#include <formats/convert/sink.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/exr/spectral_header.h>
#include <formats/image/header_attributes.h>

#include <osio/layout/presentation.h>

#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>

namespace osio::convert {

namespace {

/// A part of the output and which of the choice's channels it holds.
struct PartPlan {
    exr::OutputPart part;
    std::vector<std::size_t> planes;
};

/// A worker's blocks, converted and packed, part by part.
class Packing final : public BlockVisitor {
  public:
    Packing(exr::ExrWriter& writer, const std::vector<PartPlan>& parts, std::size_t width,
            std::uint64_t& clamped)
        : m_parts(parts), m_width(width), m_clamped(clamped) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            m_packers.push_back(writer.start_packer(p));
            m_buffers.emplace_back(parts[p].planes.size());
        }
        m_packed.resize(parts.size());
    }

    void process(const PlanarBlock& block) override {
        for (std::size_t p = 0; p < m_parts.size(); ++p) {
            std::vector<exr::ChannelRows> rows;
            for (std::size_t c = 0; c < m_parts[p].planes.size(); ++c) {
                const SampleType type = m_parts[p].part.channels[c].type;
                const auto bytes = static_cast<std::ptrdiff_t>(sample_bytes(type));
                rows.push_back({m_buffers[p][c].convert(block, m_parts[p].planes[c], type), bytes,
                                bytes * static_cast<std::ptrdiff_t>(m_width)});
            }
            m_packed[p] = m_packers[p]->pack(block.first_row, block.row_count, rows);
        }
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        std::uint64_t clamped = 0;
        for (std::size_t p = 0; p < m_parts.size(); ++p) {
            OSIO_CHECK_OK(m_packed[p]);
            for (const SampleBuffer& buffer : m_buffers[p])
                clamped += buffer.clamped();
        }
        m_clamped += clamped - m_told;
        m_told = clamped;
        for (const auto& packer : m_packers)
            OSIO_CHECK_OK(packer->write());
        return {};
    }

  private:
    const std::vector<PartPlan>& m_parts;
    std::vector<std::unique_ptr<exr::ExrWriter::Packer>> m_packers;
    std::vector<std::vector<SampleBuffer>> m_buffers;  // of each part's channels
    std::vector<Result<void>> m_packed;
    std::size_t m_width;
    std::uint64_t& m_clamped;
    std::uint64_t m_told = 0;  // of m_buffers' counts
};

class ExrFileSink final : public Sink {
  public:
    ExrFileSink(std::unique_ptr<exr::ExrWriter> writer, std::vector<PartPlan> parts, std::size_t width)
        : m_writer(std::move(writer)), m_parts(std::move(parts)), m_width(width) {}

    [[nodiscard]] std::unique_ptr<BlockVisitor> start() override {
        return std::make_unique<Packing>(*m_writer, m_parts, m_width, m_clamped);
    }

    [[nodiscard]] int rows_together() const override { return m_writer->rows_together(); }

    [[nodiscard]] Result<void> finish(files::Durability durability, Outcome& outcome) override {
        outcome.clamped_samples += m_clamped;
        return m_writer->finish(durability);
    }

  private:
    std::unique_ptr<exr::ExrWriter> m_writer;
    std::vector<PartPlan> m_parts;
    std::size_t m_width;
    std::uint64_t m_clamped = 0;
};

/// Names and types of a choice's channels as they are stored.
std::vector<exr::OutputChannel> stored_channels(const Request& request, const Choice& choice,
                                                Outcome& outcome) {
    const image::Part& part = choice.part();
    const std::vector<std::string> all = written_names(part.layout);
    std::vector<std::string> names;
    for (const std::size_t channel : choice.channels)
        names.push_back(all[channel]);
    std::vector<exr::OutputChannel> out;
    bool rounded = false;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const SampleType type = part.channels[choice.channels[c]].delivered();
        const SampleType stored = type == SampleType::Uint ? type : request.depth.value_or(type);
        rounded = rounded || (type == SampleType::Float && stored == SampleType::Half);
        out.push_back({names[c], stored});
        add_unique({std::string(sample_type_name(stored))}, outcome.types);
    }
    if (rounded)
        add_unique({"digits of floats beyond the 11 bits of a half"}, outcome.lost);
    return out;
}

std::vector<std::string> names_of(const std::vector<exr::OutputChannel>& channels) {
    std::vector<std::string> out;
    for (const exr::OutputChannel& channel : channels)
        out.push_back(channel.name);
    return out;
}

/// A part with the channels that a test on their names chooses.
template <class Wanted>
PartPlan part_of(const std::vector<exr::OutputChannel>& channels, Imf::Header header, Wanted wanted) {
    PartPlan out{{std::move(header), {}}, {}};
    for (std::size_t c = 0; c < channels.size(); ++c)
        if (wanted(channels[c].name)) {
            out.part.channels.push_back(channels[c]);
            out.planes.push_back(c);
        }
    return out;
}

/// The picture and its alpha in a part of their own, which programs open that open one part; then all else.
Result<std::vector<PartPlan>> two_parts(const Choice& choice, const std::vector<exr::OutputChannel>& channels,
                                        const Imf::Header& header) {
    const std::vector<std::string> picture = picture_names(choice.set.root);
    const auto shown = [&picture](const std::string& name) {
        return std::find(picture.begin(), picture.end(), name) != picture.end();
    };
    const std::string alpha = choice.set.root.empty() ? "A" : choice.set.root + ".A";
    std::set<std::string, std::less<>> of_bands{
        std::string(attribute::kBasis), std::string(attribute::kBinEdges), std::string(attribute::kFwhm)};
    for (auto a = header.begin(); a != header.end(); ++a)
        if (describes_bands(a.name()))
            of_bands.insert(a.name());
    Imf::Header first = header;
    image::erase_attributes(of_bands, first);
    first.setName("rgb");
    Imf::Header second = header;
    second.setName("spectral");
    std::vector<PartPlan> out;
    out.push_back(part_of(channels, std::move(first),
                          [&](const std::string& name) { return shown(name) || name == alpha; }));
    out.push_back(
        part_of(channels, std::move(second), [&](const std::string& name) { return !shown(name); }));
    if (std::count_if(channels.begin(), channels.end(),
                      [&](const exr::OutputChannel& channel) { return shown(channel.name); }) < 3)
        return fail(ErrorCode::Usage,
                    "--multi-part needs a picture R, G, B, and the image has none; add --preview "
                    "LIGHT",
                    choice.image->path());
    // What a viewer shows is called as it expects.
    for (exr::OutputChannel& channel : out[0].part.channels)
        channel.name = channel.name.substr(channel.name.rfind('.') + 1);
    return out;
}

}  // namespace

Result<std::unique_ptr<Sink>> open_exr(const Request& request, const Choice& choice, Outcome& outcome) {
    const auto channels = stored_channels(request, choice, outcome);
    Imf::Header header = choice.attributes;
    for (std::size_t c = 0; c < channels.size(); ++c)
        if (channels[c].type != choice.part().channels[choice.channels[c]].type)
            image::erase_attributes({std::string(attribute::kReduction)}, header);
    if (!request.compression.empty()) {
        OSIO_TRY(header.compression(), exr::find_compression(request.compression));
    }
    if (request.tile)
        header.setTileDescription(Imf::TileDescription(static_cast<unsigned>(request.tile->width),
                                                       static_cast<unsigned>(request.tile->height)));
    exr::complete_spectral_header(parse_channel_layout(names_of(channels), DecimalMark::Comma), header);
    std::vector<PartPlan> parts;
    if (request.multi_part) {
        OSIO_TRY(parts, two_parts(choice, channels, header));
    } else {
        parts.push_back(part_of(channels, std::move(header), [](const std::string&) { return true; }));
    }
    std::vector<exr::OutputPart> outputs;
    for (const PartPlan& plan : parts)
        outputs.push_back(plan.part);
    OSIO_TRY(auto writer, exr::ExrWriter::create(request.output, std::move(outputs)));
    return std::make_unique<ExrFileSink>(std::move(writer), std::move(parts),
                                         static_cast<std::size_t>(choice.part().data_window.width()));
}

}  // namespace osio::convert
