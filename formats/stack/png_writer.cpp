// SPDX-License-Identifier: Apache-2.0
//
// libpng leaves a call that fails by longjmp: between setjmp and there is nothing here that has a destructor.
#include <formats/stack/png_writer.h>

#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <png.h>
#include <utility>

namespace osio::stack {

/// What a call of libpng works on.
struct PngWriter::Writing {
    explicit Writing(files::ReplacementFile to) : file(std::move(to)) {}

    Writing(const Writing&) = delete;
    Writing& operator=(const Writing&) = delete;

    ~Writing() {
        png_destroy_write_struct(&png, &info);
        if (stream != nullptr)
            std::fclose(stream);
    }

    files::ReplacementFile file;
    std::FILE* stream = nullptr;
    std::array<char, 200> error{};
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::uint32_t width = 0, height = 0;
    const std::byte* samples = nullptr;
    std::size_t rows = 0;
};

namespace {

template <class Writing>
[[noreturn]] void on_error(png_structp png, png_const_charp words) {
    auto& writing = *static_cast<Writing*>(png_get_error_ptr(png));
    std::strncpy(writing.error.data(), words, writing.error.size() - 1);
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep bytes, std::size_t count) {
    if (std::fwrite(bytes, 1, count, static_cast<std::FILE*>(png_get_io_ptr(png))) != count)
        png_error(png, std::strerror(errno));
}

void on_flush(png_structp) {}

/// False where libpng failed.
template <class Writing>
bool guarded(Writing& writing, void (*step)(Writing&)) {
    if (setjmp(png_jmpbuf(writing.png)) != 0)
        return false;
    step(writing);
    return true;
}

template <class Writing>
void write_header(Writing& writing) {
    png_set_write_fn(writing.png, writing.stream, &on_write, &on_flush);
    png_set_IHDR(writing.png, writing.info, writing.width, writing.height, 16, PNG_COLOR_TYPE_GRAY,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(writing.png, writing.info);
}

template <class Writing>
void write_samples(Writing& writing) {
    const std::size_t row_bytes = std::size_t{writing.width} * 2;
    for (std::size_t row = 0; row < writing.rows; ++row)
        png_write_row(writing.png, reinterpret_cast<png_const_bytep>(writing.samples + row * row_bytes));
}

template <class Writing>
void write_end(Writing& writing) {
    png_write_end(writing.png, writing.info);
}

}  // namespace

PngWriter::PngWriter(std::unique_ptr<Writing> writing) : m_writing(std::move(writing)) {}

PngWriter::~PngWriter() = default;

tl::unexpected<Error> PngWriter::failure() const {
    return fail(ErrorCode::Io, m_writing->error[0] != '\0' ? m_writing->error.data() : std::strerror(errno),
                m_writing->file.target());
}

Result<std::unique_ptr<PngWriter>> PngWriter::create(const std::string& target, std::uint32_t width,
                                                     std::uint32_t height) {
    OSIO_TRY(files::ReplacementFile file, files::ReplacementFile::create(target));
    std::unique_ptr<PngWriter> out(new PngWriter(std::make_unique<Writing>(std::move(file))));
    Writing& writing = *out->m_writing;
    writing.width = width;
    writing.height = height;
    writing.stream = std::fopen(writing.file.path().c_str(), "wb");
    if (writing.stream == nullptr)
        return out->failure();
    writing.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writing, &on_error<Writing>, &on_warning);
    if (writing.png != nullptr)
        writing.info = png_create_info_struct(writing.png);
    if (writing.info == nullptr || !guarded(writing, &write_header<Writing>))
        return out->failure();
    return out;
}

Result<void> PngWriter::write_rows(std::span<const std::byte> samples) {
    m_writing->samples = samples.data();
    m_writing->rows = samples.size() / (std::size_t{m_writing->width} * 2);
    if (!guarded(*m_writing, &write_samples<Writing>))
        return failure();
    return {};
}

Result<void> PngWriter::finish(files::Durability durability) {
    if (!guarded(*m_writing, &write_end<Writing>))
        return failure();
    if (std::fclose(std::exchange(m_writing->stream, nullptr)) != 0)
        return failure();
    return m_writing->file.commit(durability);
}

}  // namespace osio::stack
