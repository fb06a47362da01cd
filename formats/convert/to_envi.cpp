// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/cube_output.h>
#include <formats/convert/sink.h>
#include <formats/envi/attribute_fields.h>
#include <formats/envi/envi_writer.h>
#include <formats/exr/output_header.h>

#include <algorithm>
#include <array>

namespace osio::convert {

namespace {

/// A worker's blocks as rows of floats.
class Floats final : public BlockVisitor {
  public:
    Floats(envi::EnviWriter& writer, std::size_t planes) : m_writer(writer), m_planes(planes) {}

    void process(const PlanarBlock& block) override { m_rows = m_planes.of(block); }

    [[nodiscard]] Result<void> deliver(const PlanarBlock& block) override {
        return m_writer.write_rows(block.row_count, m_rows);
    }

  private:
    envi::EnviWriter& m_writer;
    FloatPlanes m_planes;
    std::span<const float* const> m_rows;
};

/// Keys that the writer states itself.
bool is_written(const std::string& key) {
    constexpr std::array<std::string_view, 2> kWritten{"file type", "data units"};
    return envi::is_structural(key) || std::find(kWritten.begin(), kWritten.end(), key) != kWritten.end();
}

void add_fields(const Choice& choice, envi::EnviOutput& cube, std::vector<std::string>& lost) {
    const Imf::Header& header = choice.attributes;
    std::vector<std::string> names;
    for (auto a = header.begin(); a != header.end(); ++a) {
        const std::string name = a.name();
        if (is_stated(name, header, !cube.fwhm_nm.empty()))
            continue;
        if (exr::is_structural(name))
            continue;
        auto field = envi::field_of(name, a.attribute());
        if (field && is_written(field->key))
            continue;
        // Keys have no case: of two that differ in nothing else, one would hide the other.
        const bool hidden =
            field && std::any_of(cube.fields.begin(), cube.fields.end(),
                                 [&](const envi::Field& other) { return other.key == field->key; });
        if (!field || hidden || envi::counts_bands(field->key))
            names.push_back(name);
        else
            cube.fields.push_back(std::move(*field));
    }
    note_lost_attributes(names, lost);
}

/// A cube that is being written.
class EnviSink final : public Sink {
  public:
    EnviSink(std::unique_ptr<envi::EnviWriter> writer, std::size_t planes)
        : m_writer(std::move(writer)), m_planes(planes) {}

    [[nodiscard]] std::unique_ptr<BlockVisitor> start() override {
        return std::make_unique<Floats>(*m_writer, m_planes);
    }

    [[nodiscard]] Result<void> finish(files::Durability durability, Outcome& outcome) override {
        outcome.data = m_writer->data_path();
        return m_writer->finish(durability);
    }

  private:
    std::unique_ptr<envi::EnviWriter> m_writer;
    std::size_t m_planes;
};

}  // namespace

Result<std::unique_ptr<Sink>> open_envi(const Request& request, const Choice& choice, Outcome& outcome) {
    const image::Part& part = choice.part();
    envi::EnviOutput cube;
    cube.samples = static_cast<std::size_t>(part.data_window.width());
    cube.lines = static_cast<std::size_t>(part.data_window.height());
    cube.interleave = request.interleave.value_or(envi::Interleave::Bsq);
    cube.quantity = choice.set.quantity();
    cube.wavelengths_nm = choice.set.wavelengths_nm();
    cube.fwhm_nm = widths_of(choice);
    std::vector<std::string> lost;
    add_fields(choice, cube, lost);
    note_cube_losses(choice, lost);
    add_unique(std::move(lost), outcome.lost);
    outcome.types = {"float"};
    OSIO_TRY(auto writer, envi::EnviWriter::create(request.output, std::move(cube)));
    return std::make_unique<EnviSink>(std::move(writer), choice.channels.size());
}

}  // namespace osio::convert
