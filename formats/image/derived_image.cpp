// SPDX-License-Identifier: Apache-2.0
#include <formats/image/derived_image.h>

#include <osio/collapse/kernel.h>
#include <osio/collapse/weights.h>
#include <osio/layout/presentation.h>

#include <algorithm>
#include <cstring>

namespace osio::image {

namespace {

Window window_of(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, box.max.x, box.max.y};
}

/// A plane that is asked for, in terms of the planes that are read for it.
struct Plane {
    std::optional<std::size_t> copied;  ///< one of the source's planes
    std::optional<std::size_t> summed;  ///< a row of the weights
};

struct Planes {
    std::vector<Plane> planes;
    WeightMatrix weights;  ///< sums x planes of the source
};

class DerivedReader final : public BlockReader {
  public:
    DerivedReader(std::unique_ptr<BlockReader> reader, const Planes& planes)
        : m_reader(std::move(reader)), m_planes(planes) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t index) override {
        OSIO_TRY(const PlanarBlock from, m_reader->read(index));
        const std::size_t samples =
            static_cast<std::size_t>(from.row_count) * static_cast<std::size_t>(from.width);
        m_sums.resize(m_planes.weights.rows());
        for (std::vector<float>& sum : m_sums)
            sum.resize(samples);
        m_copies.resize(m_planes.planes.size());
        from.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
            std::vector<float*> out;
            for (std::vector<float>& sum : m_sums)
                out.push_back(sum.data() + first);
            if (!out.empty())
                collapse_run(planes, m_planes.weights, count, out);
        });
        PlanarBlock out{from.first_row, from.row_count, from.width, {}, 0};
        for (std::size_t p = 0; p < m_planes.planes.size(); ++p)
            out.planes.push_back(view(from, p));
        return out;
    }

  private:
    BandView view(const PlanarBlock& from, std::size_t p) {
        const Plane& plane = m_planes.planes[p];
        if (plane.summed)
            return {reinterpret_cast<const std::byte*>(m_sums[*plane.summed].data()), SampleType::Float,
                    sizeof(float)};
        if (!plane.copied)
            return {};
        const BandView& source = from.planes[*plane.copied];
        if (from.row_pitch_bytes == 0)
            return source;
        // Blocks have one pitch for all planes, and sums have none.
        const std::size_t bytes = sample_bytes(source.type);
        std::vector<std::byte>& copy = m_copies[p];
        copy.resize(static_cast<std::size_t>(from.row_count) * static_cast<std::size_t>(from.width) * bytes);
        from.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
            const BandView& run = planes[*plane.copied];
            for (std::size_t i = 0; i < count; ++i)
                std::memcpy(copy.data() + (first + i) * bytes, run.advanced(i).data, bytes);
        });
        return {copy.data(), source.type, static_cast<std::ptrdiff_t>(bytes)};
    }

    std::unique_ptr<BlockReader> m_reader;
    const Planes& m_planes;
    std::vector<std::vector<float>> m_sums;
    std::vector<std::vector<std::byte>> m_copies;
};

class DerivedSource final : public WrappedSource {
  public:
    DerivedSource(std::unique_ptr<BlockSource> source, Planes planes)
        : WrappedSource(std::move(source)), m_planes(std::move(planes)) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, inner().start_reader());
        return std::make_unique<DerivedReader>(std::move(reader), m_planes);
    }

  private:
    Planes m_planes;
};

class DerivedImage final : public SpectralImage {
  public:
    DerivedImage(std::shared_ptr<const SpectralImage> source, std::size_t part,
                 std::vector<DerivedChannel> channels, Imf::Header header)
        : SpectralImage(source->path()), m_source(std::move(source)), m_part(part),
          m_channels(std::move(channels)) {
        std::vector<Channel> described;
        for (const DerivedChannel& channel : m_channels)
            described.push_back(channel.channel);
        Part whole = described_part(std::move(described), std::move(header));
        whole.name = m_source->parts()[m_part].name;
        whole.compression = m_source->parts()[m_part].compression;
        add(std::move(whole));
    }

    [[nodiscard]] std::string_view format() const override { return m_source->format(); }

    [[nodiscard]] Result<std::unique_ptr<BlockSource>> make_block_source(std::size_t, PlaneChannels wanted,
                                                                         Grain grain) const override {
        PlaneChannels read;
        const auto plane_of = [&read](std::size_t channel) {
            const auto found = std::find(read.begin(), read.end(), std::optional(channel));
            const auto plane = static_cast<std::size_t>(found - read.begin());
            if (plane == read.size())
                read.emplace_back(channel);
            return plane;
        };
        Planes planes;
        planes.planes.resize(wanted.size());
        std::vector<std::vector<DerivedChannel::Term>> sums;
        // Sums first: products are added in the order of their terms.
        for (std::size_t p = 0; p < wanted.size(); ++p) {
            if (!wanted[p] || m_channels[*wanted[p]].source)
                continue;
            planes.planes[p].summed = sums.size();
            sums.push_back(m_channels[*wanted[p]].terms);
            for (DerivedChannel::Term& term : sums.back())
                term.channel = plane_of(term.channel);
        }
        for (std::size_t p = 0; p < wanted.size(); ++p)
            if (wanted[p] && m_channels[*wanted[p]].source)
                planes.planes[p].copied = plane_of(*m_channels[*wanted[p]].source);
        planes.weights = WeightMatrix(sums.size(), read.size());
        for (std::size_t row = 0; row < sums.size(); ++row)
            for (const DerivedChannel::Term& term : sums[row])
                planes.weights.at(row, term.channel) += term.weight;
        OSIO_TRY(auto source, m_source->make_block_source(m_part, std::move(read), grain));
        return std::make_unique<DerivedSource>(std::move(source), std::move(planes));
    }

  private:
    std::shared_ptr<const SpectralImage> m_source;
    std::size_t m_part;
    std::vector<DerivedChannel> m_channels;
};

}  // namespace

Part described_part(std::vector<Channel> channels, Imf::Header header) {
    Part part;
    part.data_window = window_of(header.dataWindow());
    part.display_window = window_of(header.displayWindow());
    std::vector<std::string> names;
    for (const Channel& channel : channels)
        names.push_back(channel.name);
    part.layout = parse_channel_layout(names, DecimalMark::Comma);
    part.metadata = read_spectral_metadata(part.layout, image::text_attributes(header));
    part.channels = std::move(channels);
    part.header = std::move(header);
    return part;
}

std::vector<std::string> derived_names(const Part& part) {
    return part.layout.dialect.name == kLayoutDialect ? part.layout.channel_names
                                                      : written_names(part.layout);
}

std::shared_ptr<const SpectralImage> derive_image(std::shared_ptr<const SpectralImage> source,
                                                  std::size_t part, std::vector<DerivedChannel> channels,
                                                  Imf::Header header) {
    return std::make_shared<DerivedImage>(std::move(source), part, std::move(channels), std::move(header));
}

}  // namespace osio::image
