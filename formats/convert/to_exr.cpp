// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/exr_parts.h>
#include <formats/convert/sink.h>
#include <formats/exr/spectral_header.h>
#include <formats/image/header_attributes.h>

#include <algorithm>

namespace osio::convert {

namespace {

class ExrFileSink final : public Sink {
  public:
    ExrFileSink(std::unique_ptr<exr::ExrWriter> writer, std::vector<PartPlan> parts, std::size_t width)
        : m_writer(std::move(writer)), m_parts(std::move(parts)), m_width(width) {}

    [[nodiscard]] std::unique_ptr<BlockVisitor> start() override {
        return std::make_unique<Packing>(*m_writer, m_parts, 0, m_width, m_clamped);
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
    OSIO_TRY(Imf::Header header, stored_header(request, choice, channels));
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
