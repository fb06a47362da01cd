// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/exr_parts.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/spectral_header.h>
#include <formats/image/header_attributes.h>

#include <osio/layout/presentation.h>

#include <OpenEXR/ImfTileDescription.h>

namespace osio::convert {

namespace {

std::vector<std::string> names_of(const std::vector<exr::OutputChannel>& channels) {
    std::vector<std::string> out;
    for (const exr::OutputChannel& channel : channels)
        out.push_back(channel.name);
    return out;
}

}  // namespace

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

Result<Imf::Header> stored_header(const Request& request, const Choice& choice,
                                  const std::vector<exr::OutputChannel>& channels) {
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
    const ChannelLayout layout = parse_channel_layout(names_of(channels), DecimalMark::Comma);
    if (!layout.sets.empty())
        exr::complete_spectral_header(layout, header);
    return header;
}

Packing::Packing(exr::ExrWriter& writer, std::span<const PartPlan> parts, std::size_t first_part,
                 std::size_t width, std::uint64_t& clamped)
    : m_parts(parts), m_width(width), m_clamped(clamped) {
    for (std::size_t p = 0; p < parts.size(); ++p) {
        m_packers.push_back(writer.start_packer(first_part + p));
        m_buffers.emplace_back(parts[p].planes.size());
    }
    m_packed.resize(parts.size());
}

void Packing::process(const PlanarBlock& block) {
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

Result<void> Packing::deliver(const PlanarBlock&) {
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

}  // namespace osio::convert
