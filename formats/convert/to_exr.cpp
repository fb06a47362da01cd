// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/samples.h>
#include <formats/convert/targets.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/exr/spectral_header.h>

#include <osio/layout/presentation.h>

#include <algorithm>

namespace osio::convert {

namespace {

/// A worker's blocks, converted and packed.
class Packing final : public BlockVisitor {
  public:
    Packing(exr::ExrWriter& writer, const std::vector<exr::OutputChannel>& channels, std::size_t width,
            std::uint64_t& clamped)
        : m_packer(writer.start_packer()), m_channels(channels), m_buffers(channels.size()), m_width(width),
          m_clamped(clamped) {}

    void process(const PlanarBlock& block) override {
        std::vector<exr::ChannelRows> rows;
        for (std::size_t c = 0; c < m_channels.size(); ++c) {
            const SampleType type = m_channels[c].type;
            const auto bytes = static_cast<std::ptrdiff_t>(sample_bytes(type));
            rows.push_back(
                {m_buffers[c].convert(block, c, type), bytes, bytes * static_cast<std::ptrdiff_t>(m_width)});
        }
        m_packed = m_packer->pack(block.first_row, block.row_count, rows);
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        OSIO_CHECK_OK(m_packed);
        std::uint64_t clamped = 0;
        for (const SampleBuffer& buffer : m_buffers)
            clamped += buffer.clamped();
        m_clamped += clamped - m_told;
        m_told = clamped;
        return m_packer->write();
    }

  private:
    std::unique_ptr<exr::ExrWriter::Packer> m_packer;
    const std::vector<exr::OutputChannel>& m_channels;
    std::vector<SampleBuffer> m_buffers;
    std::size_t m_width;
    Result<void> m_packed;
    std::uint64_t& m_clamped;
    std::uint64_t m_told = 0;  // of m_buffers' counts
};

}  // namespace

Result<void> write_exr(const Request& request, const Choice& choice, Runner& runner, const Progress& progress,
                       Outcome& outcome) {
    const image::Part& part = choice.part();
    const std::vector<std::string> all = written_names(part.layout);
    std::vector<std::string> names;
    for (const std::size_t channel : choice.channels)
        names.push_back(all[channel]);
    std::vector<exr::OutputChannel> channels;
    bool rounded = false;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const SampleType type = part.channels[choice.channels[c]].delivered();
        const SampleType stored = type == SampleType::Uint ? type : request.depth.value_or(type);
        rounded = rounded || (type == SampleType::Float && stored == SampleType::Half);
        channels.push_back({names[c], stored});
        const std::string word(sample_type_name(stored));
        if (std::find(outcome.types.begin(), outcome.types.end(), word) == outcome.types.end())
            outcome.types.push_back(word);
    }
    if (rounded)
        outcome.lost.emplace_back("digits of floats beyond the 11 bits of a half");

    Imf::Header header = choice.attributes;
    if (!request.compression.empty()) {
        OSIO_TRY(header.compression(), exr::find_compression(request.compression));
    }
    exr::complete_spectral_header(parse_channel_layout(names, DecimalMark::Comma), header);
    OSIO_TRY(const auto source,
             choice.image->make_block_source(choice.part_index, choice.planes(), image::Grain::Block));
    OSIO_TRY(const auto writer, exr::ExrWriter::create(request.output, std::move(header), channels));
    const auto width = static_cast<std::size_t>(part.data_window.width());
    const auto start = [&] {
        return std::make_unique<Packing>(*writer, channels, width, outcome.clamped_samples);
    };
    OSIO_CHECK_OK(
        visit_blocks(*source, {part.data_window.min_y, part.data_window.max_y}, runner, start, progress));
    return writer->finish();
}

}  // namespace osio::convert
