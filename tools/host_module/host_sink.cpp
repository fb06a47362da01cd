// SPDX-License-Identifier: Apache-2.0
#include <tools/host_module/host_sink.h>

#include <plugins/common/exr_metadata.h>

#include <formats/files/checked_file.h>
#include <formats/files/replacement_file.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>

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

OIIO::ImageSpec spec_of(const HostImage& image) {
    const Imath::Box2i data = image.header->dataWindow(), display = image.header->displayWindow();
    OIIO::ImageSpec spec(data.max.x - data.min.x + 1, data.max.y - data.min.y + 1,
                         static_cast<int>(image.channel_names.size()), type_of(image.type));
    spec.x = data.min.x;
    spec.y = data.min.y;
    spec.full_x = display.min.x;
    spec.full_y = display.min.y;
    spec.full_width = display.max.x - display.min.x + 1;
    spec.full_height = display.max.y - display.min.y + 1;
    spec.channelnames = image.channel_names;
    spec.alpha_channel = spec.channelnames.back() == "A" ? spec.nchannels - 1 : -1;
    plugin::add_metadata(*image.header, spec);
    return spec;
}

/// OpenImageIO's view of a checked file. Its PNG writer, for one, reports no failed write.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit CheckedProxy(const std::string& path) : IOProxy(path, Write), m_file(path) {}

    [[nodiscard]] const char* proxytype() const override { return "checked file"; }

    void close() override { m_file.close(); }

    [[nodiscard]] std::int64_t tell() override { return static_cast<std::int64_t>(m_file.position()); }

    bool seek(std::int64_t offset) override { return m_file.seek(static_cast<std::uint64_t>(offset)); }

    [[nodiscard]] std::size_t size() const override { return m_file.size(); }

    std::size_t write(const void* bytes, std::size_t count) override {
        return m_file.write(bytes, count) ? count : 0;
    }

    [[nodiscard]] files::CheckedFile& file() { return m_file; }

  private:
    files::CheckedFile m_file;
};

/// Interleaves rows, clips them where they become integers, and gives them to a writer of OIIO.
class OiioSink final : public HostSink {
  public:
    OiioSink(files::ReplacementFile file, std::unique_ptr<CheckedProxy> proxy,
             std::unique_ptr<OIIO::ImageOutput> output, StoredType type)
        : m_file(std::move(file)), m_proxy(std::move(proxy)), m_output(std::move(output)),
          m_integer(is_integer(type)), m_width(static_cast<std::size_t>(m_output->spec().width)) {}

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override {
        const std::size_t pixels = static_cast<std::size_t>(row_count) * m_width;
        m_pixels.resize(pixels * planes.size());
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            bool clipped = false;
            for (std::size_t c = 0; c < planes.size(); ++c) {
                const float value = planes[c][pixel];
                clipped |= value < 0 || value > 1;
                m_pixels[pixel * planes.size() + c] = m_integer ? in_unit_range(value) : value;
            }
            m_clipped += clipped;
        }
        const bool ok = m_output->write_scanlines(first_row, first_row + row_count, 0, OIIO::TypeDesc::FLOAT,
                                                  m_pixels.data());
        return ok ? Result<void>() : failure();
    }

    [[nodiscard]] Result<void> finish() override {
        if (!m_output->close())
            return failure();
        if (m_proxy && m_proxy->file().close() != 0)
            return fail(ErrorCode::Io, "cannot be written: " + m_proxy->file().failure(), m_file.target());
        return m_file.commit();
    }

    [[nodiscard]] std::uint64_t clipped_pixels() const override { return m_integer ? m_clipped : 0; }

  private:
    /// NaN, which no integer can hold, becomes 0.
    static float in_unit_range(float value) {
        return std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
    }

    [[nodiscard]] tl::unexpected<Error> failure() const {
        return fail(ErrorCode::Io, "cannot be written: " + m_output->geterror(), m_file.target());
    }

    files::ReplacementFile m_file;
    std::unique_ptr<CheckedProxy> m_proxy;  ///< null for the few formats that write by themselves
    std::unique_ptr<OIIO::ImageOutput> m_output;
    bool m_integer;
    std::size_t m_width;
    std::vector<float> m_pixels;
    std::uint64_t m_clipped = 0;
};

Result<std::unique_ptr<HostSink>> open_checked(const HostImage& image) {
    auto output = OIIO::ImageOutput::create(image.path);
    if (!output)
        return fail(ErrorCode::Usage,
                    "no file format is known by the ending of this name; use .exr, .png, .tif, ...",
                    image.path);
    const OIIO::ImageSpec spec = spec_of(image);
    OSIO_TRY(files::ReplacementFile file, files::ReplacementFile::create(image.path));
    std::unique_ptr<CheckedProxy> proxy;
    if (output->supports("ioproxy")) {
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
    return std::make_unique<OiioSink>(std::move(file), std::move(proxy), std::move(output), image.type);
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
