// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/cube_output.h>
#include <formats/convert/sink.h>
#include <formats/exr/output_header.h>
#include <formats/stack/png_writer.h>

#include <cmath>

namespace osio::convert {

namespace {

constexpr double kLargest = 65535;

/// A worker's blocks as shares of the largest sample, to nearest. What is no number from 0 to 1 is clipped, NaN to 0.
class Rows final : public BlockVisitor {
  public:
    Rows(stack::PngWriter& writer, std::uint64_t& clipped) : m_writer(writer), m_all_clipped(clipped) {}

    void process(const PlanarBlock& block) override {
        const std::size_t count =
            static_cast<std::size_t>(block.row_count) * static_cast<std::size_t>(block.width);
        const float* const from = m_planes.of(block)[0];
        m_samples.resize(2 * count);
        m_clipped = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const bool inside = from[i] >= 0 && from[i] <= 1;
            const float share = inside ? from[i] : from[i] > 1 ? 1.0F : 0.0F;
            m_clipped += inside ? 0U : 1U;
            const auto sample =
                static_cast<std::uint32_t>(std::lround(static_cast<double>(share) * kLargest));
            m_samples[2 * i] = static_cast<std::byte>(sample >> 8);
            m_samples[2 * i + 1] = static_cast<std::byte>(sample & 0xFF);
        }
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        m_all_clipped += m_clipped;
        return m_writer.write_rows(m_samples);
    }

  private:
    stack::PngWriter& m_writer;
    std::uint64_t& m_all_clipped;
    FloatPlanes m_planes{1};
    std::vector<std::byte> m_samples;
    std::uint64_t m_clipped = 0;
};

/// A PNG file that is being written.
class PngSink final : public Sink {
  public:
    explicit PngSink(std::unique_ptr<stack::PngWriter> writer) : m_writer(std::move(writer)) {}

    [[nodiscard]] std::unique_ptr<BlockVisitor> start() override {
        return std::make_unique<Rows>(*m_writer, m_clipped);
    }

    [[nodiscard]] Result<void> finish(files::Durability durability, Outcome& outcome) override {
        outcome.clipped_samples += m_clipped;
        return m_writer->finish(durability);
    }

  private:
    std::unique_ptr<stack::PngWriter> m_writer;
    std::uint64_t m_clipped = 0;
};

}  // namespace

Result<std::unique_ptr<Sink>> open_png(const Request& request, const Choice& choice, Outcome& outcome) {
    if (choice.channels.size() != 1)
        return fail(ErrorCode::Usage,
                    "a PNG file holds one band; found " + std::to_string(choice.channels.size()) +
                        "; --split bands writes a file of each, named by {nm}",
                    request.output);
    const image::Part& part = choice.part();
    std::vector<std::string> lost{"all but 16 bits of a sample: steps of 1/65535"}, names;
    note_cube_losses(choice, lost);
    if (choice.set.quantity() == Quantity::Radiance)
        lost.emplace_back("that the bands are radiance");
    for (auto a = choice.attributes.begin(); a != choice.attributes.end(); ++a)
        if (const std::string name = a.name();
            !is_stated(name, choice.attributes, false) && !exr::is_structural(name))
            names.push_back(name);
    note_lost_attributes(names, lost);
    add_unique(std::move(lost), outcome.lost);
    outcome.types = {"uint16"};
    OSIO_TRY(auto writer,
             stack::PngWriter::create(request.output, static_cast<std::uint32_t>(part.data_window.width()),
                                      static_cast<std::uint32_t>(part.data_window.height())));
    return std::make_unique<PngSink>(std::move(writer));
}

}  // namespace osio::convert
