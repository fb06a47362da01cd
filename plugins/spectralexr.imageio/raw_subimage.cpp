// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/exr_metadata.h>
#include <plugins/spectralexr.imageio/preview_samples.h>
#include <plugins/spectralexr.imageio/spec.h>
#include <plugins/spectralexr.imageio/subimage.h>

#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace osio::plugin {

namespace {

/// Copies a plane into every `stride`-th place; Sample has the size of a sample.
template <class Sample>
void interleave(const std::byte* plane, std::size_t count, std::byte* out, std::size_t stride) {
    for (std::size_t i = 0; i < count; ++i, plane += sizeof(Sample), out += stride)
        std::memcpy(out, plane, sizeof(Sample));
}

/// Puts blocks where the host wants them; blocks do not overlap, so workers need no order.
class Interleaver final : public BlockVisitor {
  public:
    Interleaver(RowRange rows, std::size_t width, std::size_t pixel_bytes, std::byte* out)
        : m_rows(rows), m_width(width), m_pixel_bytes(pixel_bytes), m_out(out) {}

    void process(const PlanarBlock& block) override {
        const PlanarBlock wanted = block.among(m_rows);
        std::byte* const out =
            m_out + static_cast<std::size_t>(wanted.first_row - m_rows.first) * m_width * m_pixel_bytes;
        wanted.for_each_run(
            [this, out](std::size_t first, std::size_t count, std::span<const BandView> planes) {
                interleave_run(planes, count, out + first * m_pixel_bytes);
            });
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override { return {}; }

  private:
    void interleave_run(std::span<const BandView> planes, std::size_t count, std::byte* out) const {
        for (const BandView& plane : planes) {
            if (plane.type == SampleType::Half)
                interleave<std::uint16_t>(plane.data, count, out, m_pixel_bytes);
            else
                interleave<std::uint32_t>(plane.data, count, out, m_pixel_bytes);
            out += sample_bytes(plane.type);
        }
    }

    RowRange m_rows;
    std::size_t m_width;
    std::size_t m_pixel_bytes;
    std::byte* m_out;
};

class RawSubimage final : public Subimage {
  public:
    using Subimage::Subimage;

    [[nodiscard]] Result<void> read_rows(RowRange rows, std::byte* out, Runner& runner) override {
        const auto width = static_cast<std::size_t>(spec().width);
        const std::size_t pixel_bytes = spec().pixel_bytes(true);
        const auto start = [&] { return std::make_unique<Interleaver>(rows, width, pixel_bytes, out); };
        return visit_blocks(source(), rows, runner, start, {});
    }
};

}  // namespace

Result<std::unique_ptr<Subimage>> make_raw_subimage(std::shared_ptr<const image::SpectralImage> file,
                                                    std::size_t part, BandNames names, int subimage_count) {
    const image::Part& header = file->parts()[part];
    OIIO::ImageSpec spec = spec_of_windows(header);
    if (header.tiled) {
        spec.tile_width = static_cast<int>(header.header.tileDescription().xSize);
        spec.tile_height = static_cast<int>(header.header.tileDescription().ySize);
        spec.tile_depth = 1;
    }
    image::PlaneChannels planes;
    spec.channelnames.clear();
    for (const PresentedChannel& channel : present_channels(header.layout, names)) {
        const OIIO::TypeDesc type = host_type(header.channels[channel.channel].delivered());
        if (channel.name == "A")
            spec.alpha_channel = static_cast<int>(planes.size());
        if (channel.name == "Z")
            spec.z_channel = static_cast<int>(planes.size());
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(type);
        spec.format = OIIO::TypeDesc::basetype_merge(spec.format, type);
        planes.emplace_back(channel.channel);
    }
    spec.nchannels = static_cast<int>(planes.size());
    const auto& formats = spec.channelformats;
    if (std::all_of(formats.begin(), formats.end(), [&](auto t) { return t == formats[0]; }))
        spec.channelformats.clear();
    add_metadata(header.header, spec);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("oiio:subimages", subimage_count);
    spec.attribute("compression", header.compression);
    if (PreviewChannels::find(header.layout)) {
        spec.attribute(kSourceAttribute, file->path());
        spec.attribute(kSourcePartAttribute, static_cast<int>(part));
    }
    OSIO_TRY(auto source, file->make_block_source(part, std::move(planes), image::Grain::Block));
    return std::make_unique<RawSubimage>(std::move(spec), std::move(source));
}

}  // namespace osio::plugin
