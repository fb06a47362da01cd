// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/host_runner.h>
#include <plugins/spectralexr.imageio/output.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>

namespace osio::plugin {

SpectralExrOutput::~SpectralExrOutput() {
    close();
}

int SpectralExrOutput::supports(OIIO::string_view feature) const {
    constexpr std::array<std::string_view, 9> kSupported{
        "alpha",  "nchannels",      "channelformats",     "displaywindow", "tiles",
        "origin", "negativeorigin", "arbitrary_metadata", "multiimage"};
    const std::string_view name(feature.data(), feature.size());
    return std::find(kSupported.begin(), kSupported.end(), name) != kSupported.end();
}

bool SpectralExrOutput::open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode) {
    if (mode == Create)
        return open(name, 1, &spec);
    if (mode == AppendSubimage)
        return next_subimage(spec);
    errorfmt("a spectral file has no MIP levels");
    return false;
}

bool SpectralExrOutput::open(const std::string& name, int subimages, const OIIO::ImageSpec* specs) {
    close();
    try {
        m_name = name;
        if (auto result = start(subimages, specs); !result)
            return fail_with(result.error());
        m_open = true;
    } catch (const std::exception& error) {
        return fail_with({ErrorCode::Io, error.what(), name});
    }
    return true;
}

Result<void> SpectralExrOutput::start(int subimages, const OIIO::ImageSpec* specs) {
    m_images.clear();
    m_current = 0;
    m_tile_column = 0;
    m_held = m_fsync = false;
    for (int i = 0; i < subimages; ++i) {
        OSIO_TRY(OutputImage image, OutputImage::create(specs[i], subimages == 1));
        m_held = m_held || image.must_be_held();
        m_fsync = m_fsync || specs[i].get_int_attribute(kFsyncAttribute) != 0;
        m_images.push_back(std::move(image));
    }
    if (std::none_of(m_images.begin(), m_images.end(), [](const auto& image) { return image.has_bands(); }))
        return fail(ErrorCode::NotSpectral,
                    "none of " + std::to_string(subimages) +
                        " subimages has a band; expected channels such as T.450nm, or an "
                        "output that ends in .exr");
    m_spec = current().spec();
    return m_held ? Result<void>() : start_writer();
}

Result<void> SpectralExrOutput::start_writer() {
    std::vector<exr::OutputPart> parts;
    std::vector<std::string> names;
    for (const OutputImage& image : m_images) {
        parts.push_back(image.part());
        if (m_images.size() == 1)
            break;
        std::string name = image.spec().get_string_attribute("oiio:subimagename");
        if (name.empty() || std::find(names.begin(), names.end(), name) != names.end())
            name = "part" + std::to_string(names.size());
        parts.back().header.setName(name);
        names.push_back(std::move(name));
    }
    OSIO_TRY(m_writer, exr::ExrWriter::create(m_name, std::move(parts)));
    return {};
}

bool SpectralExrOutput::next_subimage(const OIIO::ImageSpec& spec) {
    if (!m_open || m_current + 1 >= m_images.size()) {
        errorfmt("the file was opened for {} subimages, and another one comes", m_images.size());
        return false;
    }
    const OIIO::ImageSpec& expected = m_images[m_current + 1].spec();
    if (spec.width != expected.width || spec.height != expected.height ||
        spec.nchannels != expected.nchannels) {
        errorfmt("a subimage of {}x{} and {} channels comes, {}x{} and {} were announced", spec.width,
                 spec.height, spec.nchannels, expected.width, expected.height, expected.nchannels);
        return false;
    }
    ++m_current;
    m_tile_column = 0;
    m_spec = expected;
    return true;
}

bool SpectralExrOutput::write_scanline(int y, int z, OIIO::TypeDesc format, const void* data,
                                       OIIO::stride_t xstride) {
    return write_scanlines(y, y + 1, z, format, data, xstride, OIIO::AutoStride);
}

bool SpectralExrOutput::write_scanlines(int ybegin, int yend, int z, OIIO::TypeDesc format, const void* data,
                                        OIIO::stride_t xstride, OIIO::stride_t ystride) {
    if (!m_open || ybegin != current().next_row || yend <= ybegin || yend > m_spec.y + m_spec.height) {
        errorfmt("rows {} to {} were given, expected row {} next", ybegin, yend - 1,
                 m_open ? current().next_row : 0);
        return false;
    }
    try {
        OIIO::stride_t zstride = OIIO::AutoStride;
        m_spec.auto_stride(xstride, ystride, zstride, format, m_spec.nchannels, m_spec.width, yend - ybegin);
        const void* const native =
            to_native_rectangle(m_spec.x, m_spec.x + m_spec.width, ybegin, yend, z, z + 1, format, data,
                                xstride, ystride, zstride, m_scratch);
        const auto result = write_native_rows(static_cast<const std::byte*>(native), yend - ybegin);
        return result ? true : fail_with(result.error());
    } catch (const std::exception& error) {
        return fail_with({ErrorCode::Io, error.what(), m_name});
    }
}

bool SpectralExrOutput::write_tile(int x, int y, int, OIIO::TypeDesc format, const void* data,
                                   OIIO::stride_t xstride, OIIO::stride_t ystride, OIIO::stride_t zstride) {
    const int width = m_spec.tile_width, height = m_spec.tile_height;
    if (!m_open || width <= 0 || x != m_spec.x + m_tile_column * width || y != current().next_row ||
        y >= m_spec.y + m_spec.height) {
        errorfmt("the tile at {}, {} was given, expected the one at {}, {} next", x, y,
                 m_spec.x + m_tile_column * width, m_open ? current().next_row : 0);
        return false;
    }
    try {
        m_spec.auto_stride(xstride, ystride, zstride, format, m_spec.nchannels, width, height);
        const auto* const native =
            static_cast<const std::byte*>(to_native_tile(format, data, xstride, ystride, zstride, m_scratch));
        const std::size_t pixel = m_spec.pixel_bytes(true), row = m_spec.scanline_bytes(true);
        const int rows = std::min(height, m_spec.y + m_spec.height - y);
        const auto pixels = static_cast<std::size_t>(std::min(width, m_spec.x + m_spec.width - x));
        m_tiles.resize(static_cast<std::size_t>(rows) * row);
        for (std::size_t line = 0; line < static_cast<std::size_t>(rows); ++line)
            std::memcpy(m_tiles.data() + line * row + static_cast<std::size_t>(x - m_spec.x) * pixel,
                        native + line * static_cast<std::size_t>(width) * pixel, pixels * pixel);
        ++m_tile_column;
        if (x + width < m_spec.x + m_spec.width)
            return true;
        m_tile_column = 0;
        const auto result = write_native_rows(m_tiles.data(), rows);
        return result ? true : fail_with(result.error());
    } catch (const std::exception& error) {
        return fail_with({ErrorCode::Io, error.what(), m_name});
    }
}

Result<void> SpectralExrOutput::write_native_rows(const std::byte* rows, int row_count) {
    current().next_row += row_count;
    if (!m_held)
        return write_rows(m_current, rows, row_count);
    current().hold(rows, row_count);
    return {};
}

Result<void> SpectralExrOutput::write_rows(std::size_t subimage, const std::byte* rows, int row_count) {
    HostRunner runner(threads(), static_cast<std::size_t>(row_count));
    return m_writer->write_rows(row_count, m_images[subimage].channels_of(rows, row_count), &runner,
                                subimage);
}

bool SpectralExrOutput::close() {
    if (!m_open)
        return true;
    m_open = false;
    bool ok = false;
    try {
        const auto result = finish();
        ok = result ? true : fail_with(result.error());
    } catch (const std::exception& error) {
        fail_with({ErrorCode::Io, error.what(), m_name});
    }
    m_writer.reset();
    m_images.clear();
    m_tiles = std::vector<std::byte>();
    return ok;
}

Result<void> SpectralExrOutput::finish() {
    for (const OutputImage& image : m_images)
        if (const OIIO::ImageSpec& spec = image.spec(); m_held && image.next_row != spec.y + spec.height)
            return fail(ErrorCode::Io,
                        "rows from " + std::to_string(image.next_row) + " on were never written");
    if (m_held) {
        bool dropped = false;
        for (OutputImage& image : m_images)
            dropped = (image.must_be_held() && image.drop_stale_preview()) || dropped;
        // A host has no place for a warning of a writer that succeeds.
        if (dropped)
            std::fprintf(stderr, "osio: warning: R, G, B no longer match the bands and are left out of the "
                                 "spectral file\n");
        OSIO_CHECK_OK(start_writer());
        for (std::size_t i = 0; i < m_images.size(); ++i)
            OSIO_CHECK_OK(write_rows(i, m_images[i].held().data(), m_images[i].spec().height));
    }
    return m_writer->finish(m_fsync ? files::Durability::Stored : files::Durability::Handed);
}

bool SpectralExrOutput::fail_with(const Error& error) {
    errorfmt("{}", error.text());
    return false;
}

}  // namespace osio::plugin
