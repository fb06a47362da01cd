// SPDX-License-Identifier: Apache-2.0
//
// libpng leaves a call that fails by longjmp: between setjmp and there is nothing here that has a destructor.
#include <formats/image/limits.h>
#include <formats/stack/png_pixels.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <png.h>

namespace osio::stack {

namespace {

/// What a call of libpng works on.
struct Reading {
    const files::RawFile* file = nullptr;
    std::uint64_t position = 0;
    std::array<char, 200> error{};
    std::array<char, 200> warning{};  ///< the first
    png_structp png = nullptr;
    png_infop info = nullptr;
    png_bytepp rows = nullptr;
};

void keep(const char* words, std::array<char, 200>& to) {
    if (to[0] == '\0')
        std::strncpy(to.data(), words, to.size() - 1);
}

[[noreturn]] void on_error(png_structp png, png_const_charp words) {
    keep(words, static_cast<Reading*>(png_get_error_ptr(png))->error);
    png_longjmp(png, 1);
}

void on_warning(png_structp png, png_const_charp words) {
    keep(words, static_cast<Reading*>(png_get_error_ptr(png))->warning);
}

void on_read(png_structp png, png_bytep out, std::size_t count) {
    auto& reading = *static_cast<Reading*>(png_get_io_ptr(png));
    const bool ok =
        reading.file->read(reading.position, count, reinterpret_cast<std::byte*>(out)).has_value();
    if (!ok)
        png_error(png, "the file ends early");
    reading.position += count;
}

void read_header(Reading& reading) {
    png_set_user_limits(reading.png, image::kMostSidePixels, image::kMostSidePixels);
    png_set_read_fn(reading.png, &reading, &on_read);
    png_read_info(reading.png, reading.info);
}

void read_pixels(Reading& reading) {
    png_set_interlace_handling(reading.png);
    png_read_update_info(reading.png, reading.info);
    png_read_image(reading.png, reading.rows);
    png_read_end(reading.png, nullptr);
}

/// False where libpng failed.
bool guarded(Reading& reading, void (*step)(Reading&)) {
    if (setjmp(png_jmpbuf(reading.png)) != 0)
        return false;
    step(reading);
    return true;
}

/// A file between its header and its pixels.
class PngReader {
  public:
    explicit PngReader(const files::RawFile& file) {
        m_reading.file = &file;
        m_reading.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &m_reading, &on_error, &on_warning);
        if (m_reading.png != nullptr)
            m_reading.info = png_create_info_struct(m_reading.png);
    }

    ~PngReader() { png_destroy_read_struct(&m_reading.png, &m_reading.info, nullptr); }

    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    [[nodiscard]] Result<PngHeader> header() {
        if (m_reading.info == nullptr || !guarded(m_reading, &read_header))
            return broken("its header cannot be read");
        const png_structp png = m_reading.png;
        const png_infop info = m_reading.info;
        PngHeader out;
        out.width = png_get_image_width(png, info);
        out.height = png_get_image_height(png, info);
        out.bits = png_get_bit_depth(png, info);
        out.channels = png_get_channels(png, info);
        if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE || out.bits < 8)
            return fail(ErrorCode::Unsupported,
                        "is a PNG with a palette or fewer than 8 bits a sample; expected grey "
                        "or RGB of 8 or 16 bits");
        if (std::uint64_t{out.width} * out.height > image::kMostBlockBytes / pixel_bytes(out))
            return fail(ErrorCode::Unsupported, "is a PNG of more than " +
                                                    std::to_string(image::kMostBlockBytes) +
                                                    " bytes, which would have to be held at once");
        out.encoded = (png_get_valid(png, info, PNG_INFO_gAMA | PNG_INFO_sRGB | PNG_INFO_iCCP)) != 0;
        if (m_reading.warning[0] != '\0')
            out.warnings.emplace_back(m_reading.warning.data());
        m_reading.warning = {};
        return out;
    }

    /// All samples as they are stored; header() comes before.
    [[nodiscard]] Result<std::vector<std::byte>> pixels(const PngHeader& header) {
        const std::size_t row_bytes = header.width * pixel_bytes(header);
        std::vector<std::byte> out(header.height * row_bytes);
        std::vector<png_bytep> rows(header.height);
        for (std::size_t row = 0; row < rows.size(); ++row)
            rows[row] = reinterpret_cast<png_bytep>(out.data() + row * row_bytes);
        m_reading.rows = rows.data();
        if (!guarded(m_reading, &read_pixels) || m_reading.warning[0] != '\0')
            return broken("its pixels cannot be read");
        return out;
    }

    [[nodiscard]] static std::size_t pixel_bytes(const PngHeader& header) {
        return static_cast<std::size_t>(header.channels) * static_cast<std::size_t>(header.bits / 8);
    }

  private:
    [[nodiscard]] tl::unexpected<Error> broken(const std::string& what) const {
        const char* const words =
            m_reading.error[0] != '\0' ? m_reading.error.data() : m_reading.warning.data();
        return fail(ErrorCode::Damaged,
                    what + (words[0] != '\0' ? ": " + std::string(words) : std::string()));
    }

    Reading m_reading;
};

}  // namespace

Result<PngHeader> read_png_header(const files::RawFile& file) {
    return PngReader(file).header();
}

Result<std::vector<std::byte>> read_png_grey(const files::RawFile& file, const PngHeader& header) {
    PngReader reader(file);
    OSIO_TRY(const PngHeader found, reader.header());
    if (found.width != header.width || found.height != header.height || found.bits != header.bits ||
        found.channels != header.channels)
        return fail(ErrorCode::Damaged, "became another file while it was read");
    OSIO_TRY(auto bytes, reader.pixels(header));
    if (header.channels == 1)
        return bytes;
    const auto step = PngReader::pixel_bytes(header);
    const auto sample = static_cast<std::size_t>(header.bits / 8);
    const std::size_t pixels = bytes.size() / step;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::byte* const at = bytes.data() + pixel * step;
        if (header.channels >= 3 &&
            (std::memcmp(at, at + sample, sample) != 0 || std::memcmp(at, at + 2 * sample, sample) != 0))
            return fail(ErrorCode::Unsupported,
                        "has R, G and B that differ, at pixel " + std::to_string(pixel % header.width) + "," +
                            std::to_string(pixel / header.width) + "; a file of a stack is one band");
        std::memmove(bytes.data() + pixel * sample, at, sample);
    }
    bytes.resize(pixels * sample);
    return bytes;
}

}  // namespace osio::stack
