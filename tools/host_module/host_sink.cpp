// SPDX-License-Identifier: Apache-2.0
#include <tools/host_module/checked_proxy.h>
#include <tools/host_module/host_sink.h>

#include <plugins/common/exr_metadata.h>

#include <formats/files/replacement_file.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>

namespace osio::host {

namespace {

OIIO::TypeDesc type_of(StoredType type) {
    switch (type) {
    case StoredType::Uint8: return OIIO::TypeDesc::UINT8;
    case StoredType::Uint16: return OIIO::TypeDesc::UINT16;
    case StoredType::Half: return OIIO::TypeDesc::HALF;
    case StoredType::Float: break;
    }
    return OIIO::TypeDesc::FLOAT;
}

bool is_integer(StoredType type) {
    return type == StoredType::Uint8 || type == StoredType::Uint16;
}

/// The pixels that are stored: those of the data window, or of the display window where a format knows
/// no other, as oiiotool does it; never at negative places where a format has none.
Imath::Box2i frame_of(const Imf::Header& header, const OIIO::ImageOutput& output) {
    const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
    if (!output.supports("displaywindow"))
        return display;
    if (output.supports("negativeorigin"))
        return data;
    const Imath::Box2i seen({std::max(data.min.x, 0), std::max(data.min.y, 0)}, data.max);
    return seen.isEmpty() ? display : seen;
}

OIIO::ImageSpec spec_of(const HostImage& image, const Imath::Box2i& frame, bool has_display_window) {
    const Imath::Box2i display = image.header->displayWindow();
    OIIO::ImageSpec spec(frame.max.x - frame.min.x + 1, frame.max.y - frame.min.y + 1,
                         static_cast<int>(image.channel_names.size()), type_of(image.type));
    if (has_display_window) {
        spec.x = frame.min.x;
        spec.y = frame.min.y;
        spec.full_x = display.min.x;
        spec.full_y = display.min.y;
        spec.full_width = display.max.x - display.min.x + 1;
        spec.full_height = display.max.y - display.min.y + 1;
    }
    spec.channelnames = image.channel_names;
    spec.alpha_channel = spec.channelnames.back() == "A" ? spec.nchannels - 1 : -1;
    plugin::add_metadata(*image.header, spec);
    return spec;
}

/// OpenImageIO 2.4.7 writes TIFF with an Exif directory (any sRGB image) behind a proxy so that the
/// header leads to the Exif directory instead of the image.
bool loses_directory_behind_proxy(const OIIO::ImageOutput& output) {
    return std::string_view(output.format_name()) == "tiff";
}

/// Opens what was written as a user will: some of OpenImageIO's writers report success for a file that
/// no reader takes. Reads from `first_row` of the pixels on.
Result<void> check_written(const std::string& path, const OIIO::ImageOutput& writer, int first_row,
                           const std::string& target) {
    const auto unreadable = [&target](const std::string& why) {
        return fail(ErrorCode::Io,
                    "what was written cannot be read again (" + why + "); write another format", target);
    };
    const auto reader = OIIO::ImageInput::create(writer.format_name());
    OIIO::ImageSpec spec;
    if (!reader)
        return unreadable(std::string(writer.format_name()) + " has no reader");
    if (!reader->open(path, spec))
        return unreadable(reader->geterror());
    if (spec.width != writer.spec().width || spec.height != writer.spec().height)
        return unreadable("another size was found");
    if (spec.tile_width > 0)
        return {};
    std::vector<float> row(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels));
    for (int y = spec.y + first_row; y < spec.y + spec.height; ++y)
        if (!reader->read_scanline(y, 0, OIIO::TypeDesc::FLOAT, row.data()))
            return unreadable(reader->geterror());
    return {};
}

/// Interleaves rows, places them in the frame, clips them where they become integers, and gives them to
/// a writer of OpenImageIO. What the frame has beyond the data window is black.
class OiioSink final : public HostSink {
  public:
    OiioSink(files::ReplacementFile file, std::unique_ptr<CheckedProxy> proxy,
             std::unique_ptr<OIIO::ImageOutput> output, const HostImage& image, const Imath::Box2i& frame)
        : m_file(std::move(file)), m_proxy(std::move(proxy)), m_output(std::move(output)),
          m_integer(is_integer(image.type)), m_durability(image.durability),
          m_data(image.header->dataWindow()), m_frame(frame), m_next_row(frame.min.y) {}

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override {
        const int first = std::max(first_row, m_frame.min.y);
        const int last = std::min(first_row + row_count - 1, m_frame.max.y);
        OSIO_CHECK_OK(write_black_until(std::min(first_row, m_frame.max.y + 1)));
        if (first > last)
            return {};
        reserve_black(last - first + 1);
        for (int y = first; y <= last; ++y)
            place(y - first_row, y - first, planes);
        return write_next(last - first + 1);
    }

    [[nodiscard]] Result<void> finish() override {
        OSIO_CHECK_OK(write_black_until(m_frame.max.y + 1));
        if (!m_output->close())
            return failure();
        if (m_proxy && m_proxy->file().close() != 0)
            return fail(ErrorCode::Io, "cannot be written: " + m_proxy->file().failure(), m_file.target());
        // Behind a proxy every byte is known to be stored, and the last row tells the rest.
        const int first_checked = m_proxy ? m_output->spec().height - 1 : 0;
        OSIO_CHECK_OK(check_written(m_file.path(), *m_output, first_checked, m_file.target()));
        return m_file.commit(m_durability);
    }

    [[nodiscard]] std::uint64_t clipped_pixels() const override { return m_integer ? m_clipped : 0; }

  private:
    /// NaN, which no integer can hold, becomes 0.
    static float in_unit_range(float value) {
        return std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
    }

    [[nodiscard]] std::size_t channel_count() const {
        return static_cast<std::size_t>(m_output->spec().nchannels);
    }

    [[nodiscard]] std::size_t frame_width() const {
        return static_cast<std::size_t>(m_frame.max.x - m_frame.min.x + 1);
    }

    void reserve_black(int row_count) {
        m_pixels.assign(static_cast<std::size_t>(row_count) * frame_width() * channel_count(), 0.0F);
    }

    /// Row `from` of the planes into row `to` of the pixels.
    void place(int from, int to, std::span<const float* const> planes) {
        const auto data_width = static_cast<std::size_t>(m_data.max.x - m_data.min.x + 1);
        for (int x = std::max(m_data.min.x, m_frame.min.x); x <= std::min(m_data.max.x, m_frame.max.x); ++x) {
            const std::size_t source =
                static_cast<std::size_t>(from) * data_width + static_cast<std::size_t>(x - m_data.min.x);
            float* const pixel = &m_pixels[(static_cast<std::size_t>(to) * frame_width() +
                                            static_cast<std::size_t>(x - m_frame.min.x)) *
                                           planes.size()];
            bool clipped = false;
            for (std::size_t c = 0; c < planes.size(); ++c) {
                const float value = planes[c][source];
                clipped |= value < 0 || value > 1;
                pixel[c] = m_integer ? in_unit_range(value) : value;
            }
            m_clipped += clipped;
        }
    }

    [[nodiscard]] Result<void> write_black_until(int row) {
        if (row <= m_next_row)
            return {};
        reserve_black(row - m_next_row);
        return write_next(row - m_next_row);
    }

    /// The pixels as the next rows of the file, whose rows count from its own first.
    [[nodiscard]] Result<void> write_next(int row_count) {
        const int begin = m_output->spec().y + m_next_row - m_frame.min.y;
        m_next_row += row_count;
        const bool ok =
            m_output->write_scanlines(begin, begin + row_count, 0, OIIO::TypeDesc::FLOAT, m_pixels.data());
        return ok ? Result<void>() : failure();
    }

    [[nodiscard]] tl::unexpected<Error> failure() const {
        return fail(ErrorCode::Io, "cannot be written: " + m_output->geterror(), m_file.target());
    }

    files::ReplacementFile m_file;
    std::unique_ptr<CheckedProxy> m_proxy;        ///< null for the few formats that write by themselves
    std::unique_ptr<OIIO::ImageOutput> m_output;  // after the proxy: it writes until it is gone
    bool m_integer;
    files::Durability m_durability;
    Imath::Box2i m_data;
    Imath::Box2i m_frame;
    int m_next_row;
    std::vector<float> m_pixels;
    std::uint64_t m_clipped = 0;
};

Result<std::unique_ptr<HostSink>> open_checked(const HostImage& image) {
    std::unique_ptr<CheckedProxy> proxy;  // before the output, which writes until it is gone
    auto output = OIIO::ImageOutput::create(image.path);
    if (!output)
        return fail(ErrorCode::Usage,
                    "no file format is known by the ending of this name; use .exr, .png, .tif, ...",
                    image.path);
    const Imath::Box2i frame = frame_of(*image.header, *output);
    const OIIO::ImageSpec spec = spec_of(image, frame, output->supports("displaywindow") != 0);
    OSIO_TRY(files::ReplacementFile file, files::ReplacementFile::create(image.path));
    if (output->supports("ioproxy") && !loses_directory_behind_proxy(*output)) {
        proxy = std::make_unique<CheckedProxy>(file.path());
        output->set_ioproxy(proxy.get());
    }
    if (!output->open(file.path(), spec))
        return fail(ErrorCode::Io, "cannot be written: " + output->geterror(), image.path);
    if (output->spec().format != spec.format)
        return fail(ErrorCode::Usage,
                    std::string(output->format_name()) + " stores " + output->spec().format.c_str() +
                        ", not " + spec.format.c_str() +
                        "; name a type it can store with -d, or write an .exr",
                    image.path);
    return std::make_unique<OiioSink>(std::move(file), std::move(proxy), std::move(output), image, frame);
}

}  // namespace

Result<std::unique_ptr<HostSink>> open_host_sink(const HostImage& image) {
    try {
        return open_checked(image);
    } catch (const std::exception& error) {
        return fail(ErrorCode::Io, error.what(), image.path);
    }
}

}  // namespace osio::host
