// SPDX-License-Identifier: Apache-2.0
#include <formats/files/checked_file.h>
#include <formats/tiff/strip_packer.h>
#include <formats/tiff/text_tags.h>
#include <formats/tiff/tiff_messages.h>
#include <formats/tiff/tiff_writer.h>

#include <osio/base/text.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <limits>

namespace osio::tiff {

namespace {

/// Bytes of a strip: enough to pack well, and little to unpack for a few pixels.
constexpr std::size_t kStripBytes = std::size_t{1} << 18;

/// Bytes that the strips of all bands take together: a worker holds them.
constexpr std::size_t kRowsBytes = std::size_t{1} << 24;

/// Files that may grow beyond become BigTIFF: 32 bits of offset, less room for the directory.
constexpr std::uint64_t kMostClassicBytes = 0xF0000000;

/// Bytes of a strip's place and size in a directory of BigTIFF.
constexpr std::uint64_t kPlaceBytes = 16;

/// GDAL's tags made known to one handle.
void merge_gdal_tags(TIFF* tiff) {
    static std::array<char, 16> metadata{"GDALMetadata"}, no_data{"GDALNoData"};
    static const std::array<TIFFFieldInfo, 2> kFields{
        {{kGdalMetadata, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, metadata.data()},
         {kGdalNoData, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, no_data.data()}}};
    TIFFMergeFieldInfo(tiff, kFields.data(), kFields.size());
}

GdalItem item(std::string name, std::string value) {
    return {std::move(name), std::move(value), {}, {}, {}};
}

}  // namespace

std::vector<GdalItem> items_of(const TiffOutput& output) {
    std::vector<GdalItem> out;
    out.push_back(item("data_units", output.quantity == Quantity::Radiance ? "Radiance" : "Reflectance"));
    out.insert(out.end(), output.items.begin(), output.items.end());
    for (std::size_t band = 0; band < output.wavelengths_nm.size(); ++band) {
        const double nm = output.wavelengths_nm[band];
        const auto add = [&](const char* name, const std::string& value, const char* domain = "",
                             const char* role = "") {
            out.push_back({name, value, band, domain, role});
        };
        add("wavelength", format_double(nm));
        add("wavelength_units", "Nanometers");
        add("CENTRAL_WAVELENGTH_UM", format_double(nm / 1000), "IMAGERY");
        add("DESCRIPTION", format_double(nm) + " nm", "", "description");
        if (!output.fwhm_nm.empty()) {
            add("fwhm", format_double(output.fwhm_nm[band]));
            add("FWHM_UM", format_double(output.fwhm_nm[band] / 1000), "IMAGERY");
        }
    }
    return out;
}

struct TiffWriter::State {
    State(TiffOutput to_write, files::ReplacementFile replacement)
        : output(std::move(to_write)), target(std::move(replacement)), file(target.path()) {}

    ~State() { close(); }

    void close() {
        if (tiff != nullptr)
            TIFFClose(std::exchange(tiff, nullptr));
    }

    [[nodiscard]] std::size_t bands() const { return output.wavelengths_nm.size(); }

    [[nodiscard]] Result<void> check(bool ok) const {
        if (ok && messages.error.empty() && file.failure().empty())
            return {};
        return fail(ErrorCode::Io,
                    "cannot be written: " + (file.failure().empty() ? messages.error : file.failure()),
                    target.target());
    }

    [[nodiscard]] Result<void> open() {
        const auto read = [](void*, void*, tmsize_t) -> tmsize_t { return -1; };
        const auto write = [](void* self, void* bytes, tmsize_t count) -> tmsize_t {
            auto& state = *static_cast<State*>(self);
            return state.file.write(bytes, static_cast<std::size_t>(count)) ? count : -1;
        };
        const auto seek = [](void* self, toff_t offset, int whence) -> toff_t {
            auto& state = *static_cast<State*>(self);
            if (whence == SEEK_CUR)
                offset += state.file.position();
            else if (whence == SEEK_END)
                offset += state.file.size();
            return state.file.seek(offset) ? offset : std::numeric_limits<toff_t>::max();
        };
        const auto size = [](void* self) -> toff_t { return static_cast<State*>(self)->file.size(); };
        const std::uint64_t samples = std::uint64_t{output.width} * output.height * bands();
        const std::uint64_t strips = ((output.height - 1) / rows_per_strip + 1) * bands();
        const bool big = samples > kMostClassicBytes / sizeof(float) ||
                         samples * sizeof(float) + strips * kPlaceBytes > kMostClassicBytes;
        tiff = messages.open(big ? "w8" : "w", this, read, write, seek, size);
        OSIO_CHECK_OK(check(tiff != nullptr));
        merge_gdal_tags(tiff);
        bool ok = true;
        const auto set = [&](std::uint32_t tag, auto... values) {
            ok = TIFFSetField(tiff, tag, values...) == 1 && ok;
        };
        set(TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(output.width));
        set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(output.height));
        set(TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(bands()));
        set(TIFFTAG_BITSPERSAMPLE, 32);
        set(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
        set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_SEPARATE);
        set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        set(TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(rows_per_strip));
        set(TIFFTAG_COMPRESSION, output.deflate ? COMPRESSION_ADOBE_DEFLATE : COMPRESSION_NONE);
        if (output.deflate)
            set(TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
        if (bands() > 1) {
            const std::vector<std::uint16_t> extra(bands() - 1, EXTRASAMPLE_UNSPECIFIED);
            set(TIFFTAG_EXTRASAMPLES, static_cast<int>(extra.size()), extra.data());
        }
        for (const auto& [name, text] : output.texts)
            if (const auto tag = find_text_tag(name))
                set(*tag, text.c_str());
        set(kGdalMetadata, gdal_metadata_text(items_of(output)).c_str());
        set(kGdalNoData, "nan");
        return check(ok);
    }

    TiffOutput output;
    files::ReplacementFile target;
    files::CheckedFile file;
    Messages messages;
    TIFF* tiff = nullptr;
    std::size_t rows_per_strip = 1;
    std::size_t rows_written = 0;
};

/// A worker's strips.
class TiffWriter::StripRows final : public TiffWriter::Packer {
  public:
    explicit StripRows(State& state) : m_state(state) {}

    void pack(int first_row, int row_count, std::span<const float* const> planes) override {
        m_bytes.clear();
        m_strips.clear();
        m_rows = static_cast<std::size_t>(row_count);
        const std::size_t rows_per_strip = m_state.rows_per_strip, width = m_state.output.width;
        const std::size_t down = (m_state.output.height - 1) / rows_per_strip + 1;
        for (std::size_t band = 0; band < planes.size(); ++band)
            for (std::size_t row = 0; row < m_rows; row += rows_per_strip) {
                const std::size_t rows = std::min(rows_per_strip, m_rows - row);
                const std::size_t index =
                    band * down + (static_cast<std::size_t>(first_row) + row) / rows_per_strip;
                const float* const from = planes[band] + row * width;
                std::size_t size = rows * width * sizeof(float);
                if (m_state.output.deflate) {
                    size = m_packer.pack(from, width, rows, m_bytes);
                } else {
                    const auto* const bytes = reinterpret_cast<const std::byte*>(from);
                    m_bytes.insert(m_bytes.end(), bytes, bytes + size);
                }
                m_strips.push_back({index, size});
            }
    }

    [[nodiscard]] Result<void> write() override {
        std::byte* at = m_bytes.data();
        for (const Strip& strip : m_strips) {
            const tmsize_t size = static_cast<tmsize_t>(strip.bytes);
            OSIO_CHECK_OK(m_state.check(
                TIFFWriteRawStrip(m_state.tiff, static_cast<std::uint32_t>(strip.index), at, size) == size));
            at += strip.bytes;
        }
        m_state.rows_written += m_rows;
        return {};
    }

  private:
    struct Strip {
        std::size_t index = 0, bytes = 0;
    };

    State& m_state;
    StripPacker m_packer;
    std::vector<std::byte> m_bytes;
    std::vector<Strip> m_strips;
    std::size_t m_rows = 0;
};

TiffWriter::TiffWriter(std::unique_ptr<State> state) : m_state(std::move(state)) {}

TiffWriter::~TiffWriter() = default;

Result<std::unique_ptr<TiffWriter>> TiffWriter::create(const std::string& path, TiffOutput output) {
    const std::size_t bands = output.wavelengths_nm.size();
    if (bands > std::numeric_limits<std::uint16_t>::max())
        return fail(ErrorCode::Unsupported,
                    std::to_string(bands) + " bands are more than a TIFF file holds, 65535", path);
    OSIO_TRY(auto replacement, files::ReplacementFile::create(path));
    const std::size_t row_bytes = output.width * sizeof(float);
    // Powers of two: the strips of files that are written side by side fit into each other's.
    const std::size_t most =
        std::max<std::size_t>(std::min(kStripBytes / row_bytes, kRowsBytes / row_bytes / bands), 1);
    const std::size_t rows = std::min(std::bit_floor(most), output.height);
    auto state = std::make_unique<State>(std::move(output), std::move(replacement));
    state->rows_per_strip = rows;
    OSIO_CHECK_OK(state->open());
    return std::unique_ptr<TiffWriter>(new TiffWriter(std::move(state)));
}

int TiffWriter::rows_per_strip() const {
    return static_cast<int>(m_state->rows_per_strip);
}

std::unique_ptr<TiffWriter::Packer> TiffWriter::start_packer() {
    return std::make_unique<StripRows>(*m_state);
}

Result<void> TiffWriter::finish(files::Durability durability) {
    State& state = *m_state;
    if (state.rows_written != state.output.height)
        return fail(ErrorCode::Io,
                    std::to_string(state.output.height - state.rows_written) + " rows were never written",
                    state.target.target());
    OSIO_CHECK_OK(state.check(TIFFWriteDirectory(state.tiff) == 1));
    state.close();
    OSIO_CHECK_OK(state.check(state.file.close() == 0));
    return state.target.commit(durability);
}

}  // namespace osio::tiff
