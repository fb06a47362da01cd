// SPDX-License-Identifier: Apache-2.0
#include <formats/image/even_rows.h>
#include <formats/image/number_rows.h>
#include <formats/stack/png_file.h>

#include <osio/base/text.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <mutex>

namespace osio::stack {

/// The file's pixels, unpacked by the first reader that asks.
class PngFile::Rows final : public image::EvenRows {
  public:
    Rows(std::shared_ptr<const PngFile> file, image::PlaneChannels planes, int rows_per_block)
        : EvenRows(static_cast<int>(file->m_header.width), static_cast<int>(file->m_header.height),
                   rows_per_block),
          m_file(std::move(file)), m_planes(std::move(planes)) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override;

    [[nodiscard]] const PngFile& file() const { return *m_file; }

    [[nodiscard]] const image::PlaneChannels& planes() const { return m_planes; }

    [[nodiscard]] const Result<std::vector<std::byte>>& numbers() const {
        std::call_once(m_once, [this] { m_numbers = read_png_grey(m_file->m_file, m_file->m_header); });
        return m_numbers;
    }

  private:
    std::shared_ptr<const PngFile> m_file;
    image::PlaneChannels m_planes;
    mutable std::once_flag m_once;
    mutable Result<std::vector<std::byte>> m_numbers;
};

class PngFile::Reader final : public BlockReader {
  public:
    explicit Reader(const Rows& rows) : m_rows(rows) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const auto& numbers = m_rows.numbers();
        if (!numbers)
            return fail_in(m_rows.file().path(), numbers.error());
        const RowRange range = m_rows.rows_of_block(block);
        const PngHeader& header = m_rows.file().m_header;
        const auto width = std::size_t{header.width};
        const auto type = header.bits == 8 ? image::NumberType::Uint8 : image::NumberType::Uint16;
        m_floats.resize(static_cast<std::size_t>(range.last - range.first + 1) * width);
        image::to_floats(
            numbers->data() + static_cast<std::size_t>(range.first) * width * image::number_bytes(type), 1,
            m_floats.size(), type, true, {1, 0, m_rows.file().m_divisor, {}}, m_floats.data());
        PlanarBlock out{range.first, range.last - range.first + 1, static_cast<int>(header.width), {}};
        for (const auto& plane : m_rows.planes())
            out.planes.push_back({reinterpret_cast<const std::byte*>(plane ? m_floats.data() : nullptr),
                                  SampleType::Float, sizeof(float)});
        return out;
    }

  private:
    const Rows& m_rows;
    std::vector<float> m_floats;
};

Result<std::unique_ptr<BlockReader>> PngFile::Rows::start_reader() const {
    return std::make_unique<Reader>(*this);
}

Result<std::shared_ptr<const PngFile>> PngFile::open(const std::string& path, std::optional<double> scale) {
    OSIO_TRY(files::RawFile file, files::RawFile::open(path));
    auto header = read_png_header(file);
    if (!header)
        return fail_in(path, header.error());
    const double most = header->bits == 8 ? 255 : 65535;
    image::Part part;
    part.data_window = part.display_window = {0, 0, static_cast<int>(header->width) - 1,
                                              static_cast<int>(header->height) - 1};
    part.header = Imf::Header(part.data_window.width(), part.data_window.height());
    part.compression = "zip";
    part.storage = "PNG of " + std::string(header->bits == 8 ? "uint8" : "uint16");
    part.channels.push_back({"Y", SampleType::Float, false});
    part.layout = parse_channel_layout(std::vector<std::string>{"Y"}, DecimalMark::Comma);
    part.layout.warnings = header->warnings;
    if (!scale)
        part.layout.warnings.push_back("numbers of PNG files are divided by " + format_double(most) +
                                       ", the largest of their type, as that format means them");
    if (header->encoded)
        part.layout.warnings.emplace_back("what PNG files say of encoding for a display (gAMA, sRGB, iCCP) "
                                          "is ignored: numbers count as linear");
    const std::shared_ptr<PngFile> out(
        new PngFile(path, std::move(file), std::move(*header), scale.value_or(most)));
    out->add(std::move(part));
    return out;
}

Result<std::unique_ptr<BlockSource>> PngFile::make_block_source(std::size_t, image::PlaneChannels planes,
                                                                image::Grain grain) const {
    const auto rows =
        grain == image::Grain::Chunk
            ? std::uint64_t{1}
            : std::clamp<std::uint64_t>(image::EvenRows::kBlockBytes / (m_header.width * sizeof(float)), 1,
                                        m_header.height);
    return std::make_unique<Rows>(shared_from_this(), std::move(planes), static_cast<int>(rows));
}

bool starts_like_png(const std::string& path) {
    constexpr std::array<char, 8> kMagic{'\x89', 'P', 'N', 'G', '\r', '\n', '\x1a', '\n'};
    std::array<char, 8> head{};
    std::ifstream in(path, std::ios::binary);
    in.read(head.data(), head.size());
    return in.gcount() == static_cast<std::streamsize>(head.size()) && head == kMagic;
}

}  // namespace osio::stack
