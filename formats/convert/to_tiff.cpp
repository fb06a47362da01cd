// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/cube_output.h>
#include <formats/convert/sink.h>
#include <formats/exr/output_header.h>
#include <formats/tiff/attribute_items.h>
#include <formats/tiff/tiff_writer.h>

namespace osio::convert {

namespace {

/// A worker's blocks as strips.
class Strips final : public BlockVisitor {
  public:
    Strips(tiff::TiffWriter& writer, std::size_t planes, int first_row)
        : m_packer(writer.start_packer()), m_planes(planes), m_first_row(first_row) {}

    void process(const PlanarBlock& block) override {
        m_packer->pack(block.first_row - m_first_row, block.row_count, m_planes.of(block));
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override { return m_packer->write(); }

  private:
    std::unique_ptr<tiff::TiffWriter::Packer> m_packer;
    FloatPlanes m_planes;
    int m_first_row;
};

/// A TIFF file that is being written.
class TiffSink final : public Sink {
  public:
    TiffSink(std::unique_ptr<tiff::TiffWriter> writer, std::size_t planes, int first_row)
        : m_writer(std::move(writer)), m_planes(planes), m_first_row(first_row) {}

    [[nodiscard]] std::unique_ptr<BlockVisitor> start() override {
        return std::make_unique<Strips>(*m_writer, m_planes, m_first_row);
    }

    [[nodiscard]] int rows_together() const override { return m_writer->rows_per_strip(); }

    [[nodiscard]] Result<void> finish(files::Durability durability, Outcome&) override {
        return m_writer->finish(durability);
    }

  private:
    std::unique_ptr<tiff::TiffWriter> m_writer;
    std::size_t m_planes;
    int m_first_row;
};

void add_attributes(const Choice& choice, tiff::TiffOutput& output, std::vector<std::string>& lost) {
    std::vector<std::string> names;
    for (auto a = choice.attributes.begin(); a != choice.attributes.end(); ++a) {
        const std::string name = a.name();
        if (is_stated(name, choice.attributes, !output.fwhm_nm.empty()) || exr::is_structural(name))
            continue;
        if (!tiff::add_attribute(name, a.attribute(), output))
            names.push_back(name);
    }
    note_lost_attributes(names, lost);
}

}  // namespace

Result<std::unique_ptr<Sink>> open_tiff(const Request& request, const Choice& choice, Outcome& outcome) {
    const image::Part& part = choice.part();
    tiff::TiffOutput output;
    output.width = static_cast<std::size_t>(part.data_window.width());
    output.height = static_cast<std::size_t>(part.data_window.height());
    output.quantity = choice.set.quantity();
    output.wavelengths_nm = choice.set.wavelengths_nm();
    output.fwhm_nm = widths_of(choice);
    output.deflate = request.compression != "none";
    std::vector<std::string> lost;
    add_attributes(choice, output, lost);
    note_cube_losses(choice, lost);
    add_unique(std::move(lost), outcome.lost);
    outcome.types = {"float"};
    OSIO_TRY(auto writer, tiff::TiffWriter::create(request.output, std::move(output)));
    return std::make_unique<TiffSink>(std::move(writer), choice.channels.size(), part.data_window.min_y);
}

}  // namespace osio::convert
