// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/exr_metadata.h>
#include <plugins/common/host_runner.h>
#include <plugins/spectralexr.imageio/output.h>
#include <plugins/spectralexr.imageio/spec.h>

#include <formats/exr/exr_file.h>
#include <formats/exr/output_header.h>
#include <formats/exr/spectral_header.h>
#include <formats/image/colour_attributes.h>

#include <osio/layout/presentation.h>

#include <OpenEXR/ImfStandardAttributes.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <set>

namespace osio::plugin {

namespace {

/// What OpenEXR can store without loss of what the host has.
SampleType stored_type(OIIO::TypeDesc type) {
    switch (type.basetype) {
    case OIIO::TypeDesc::HALF: return SampleType::Half;
    case OIIO::TypeDesc::UINT32: return SampleType::Uint;
    default: return SampleType::Float;
    }
}

Imf::Header header_of_windows(const OIIO::ImageSpec& spec) {
    const Imath::Box2i data({spec.x, spec.y}, {spec.x + spec.width - 1, spec.y + spec.height - 1});
    const int full_width = spec.full_width > 0 ? spec.full_width : spec.width;
    const int full_height = spec.full_height > 0 ? spec.full_height : spec.height;
    const Imath::Box2i display({spec.full_x, spec.full_y},
                               {spec.full_x + full_width - 1, spec.full_y + full_height - 1});
    return {display, data};
}

/// The host's `compression`, with its quality; zip where it names none that OpenEXR has.
void set_compression(const OIIO::ImageSpec& spec, Imf::Header& header) {
    const auto [name, quality] = spec.decode_compression_metadata("zip", -1);
    header.compression() =
        exr::find_compression(std::string_view(name.data(), name.size())).value_or(Imf::ZIP_COMPRESSION);
    const bool dwa =
        header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
    if (dwa && quality > 0)
        header.dwaCompressionLevel() = static_cast<float>(quality);
    if (!dwa && quality >= 1 && quality <= 9)
        header.zipCompressionLevel() = quality;
}

}  // namespace

SpectralExrOutput::~SpectralExrOutput() {
    close();
}

int SpectralExrOutput::supports(OIIO::string_view feature) const {
    constexpr std::array<std::string_view, 7> kSupported{
        "alpha",  "nchannels",      "channelformats",    "displaywindow",
        "origin", "negativeorigin", "arbitrary_metadata"};
    const std::string_view name(feature.data(), feature.size());
    return std::find(kSupported.begin(), kSupported.end(), name) != kSupported.end();
}

bool SpectralExrOutput::open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode) {
    close();
    if (mode != Create) {
        errorfmt("a spectral file holds one image; further subimages and MIP levels are not written");
        return false;
    }
    try {
        m_name = name;
        m_spec = spec;
        if (auto result = start(); !result)
            return fail_with(result.error());
        m_open = true;
    } catch (const std::exception& error) {
        return fail_with({ErrorCode::Io, error.what(), name});
    }
    return true;
}

Result<void> SpectralExrOutput::start() {
    if (m_spec.width < 1 || m_spec.height < 1 || m_spec.depth > 1 || m_spec.deep)
        return fail(ErrorCode::Unsupported, "a spectral file holds flat images of at least 1x1 pixels");
    m_layout = parse_channel_layout(layout_names(m_spec.channelnames), DecimalMark::Comma);
    const auto& names = m_layout.channel_names;
    if (names.size() != static_cast<std::size_t>(m_spec.nchannels) ||
        std::set<std::string>(names.begin(), names.end()).size() != names.size() || m_layout.find_channel(""))
        return fail(ErrorCode::Usage, "every channel needs a name of its own");
    if (m_layout.sets.empty())
        return fail(ErrorCode::NotSpectral,
                    "none of " + std::to_string(names.size()) +
                        " channels is a band; expected names such as T.450nm or S0.550.5nm, or an "
                        "output that ends in .exr");

    m_types.clear();
    m_offsets.clear();
    std::ptrdiff_t offset = 0;
    std::vector<OIIO::TypeDesc> formats;
    for (int c = 0; c < m_spec.nchannels; ++c) {
        m_types.push_back(stored_type(m_spec.channelformat(c)));
        formats.push_back(host_type(m_types.back()));
        m_offsets.push_back(offset);
        offset += static_cast<std::ptrdiff_t>(sample_bytes(m_types.back()));
    }
    m_spec.format = formats.front();
    const bool uniform = std::all_of(formats.begin(), formats.end(),
                                     [&](OIIO::TypeDesc type) { return type == formats.front(); });
    m_spec.channelformats = uniform ? std::vector<OIIO::TypeDesc>() : std::move(formats);
    m_spec.tile_width = m_spec.tile_height = m_spec.tile_depth = 0;

    m_next_row = m_spec.y;
    m_preview = PreviewChannels::find(m_layout);
    if (!m_preview) {
        OSIO_TRY(m_writer, make_writer(true));
        return {};
    }
    // Before anything is written: the source may be the file that is about to be replaced.
    m_source_samples =
        preview_samples_of_file(m_spec.get_string_attribute(kSourceAttribute),
                                static_cast<std::size_t>(m_spec.get_int_attribute(kSourcePartAttribute)));
    m_held.reserve(m_spec.image_bytes(true));
    return {};
}

Result<std::unique_ptr<exr::ExrWriter>> SpectralExrOutput::make_writer(bool with_preview) const {
    Imf::Header header = header_of_windows(m_spec);
    set_compression(m_spec, header);
    insert_metadata(m_spec, header);
    for (const char* name : {image::attribute::kRecipe, image::attribute::kPlan, image::attribute::kWarnings,
                             kSourceAttribute, kSourcePartAttribute, kFsyncAttribute})
        header.erase(name);
    exr::complete_spectral_header(m_layout, header);
    if (!with_preview) {
        header.erase(image::attribute::kChromaticities);
        header.erase(std::string(attribute::kExposureValue));
    }
    std::vector<exr::OutputChannel> channels;
    for (std::size_t c = 0; c < m_types.size(); ++c)
        if (with_preview || !is_preview(c))
            channels.push_back({m_layout.channel_names[c], m_types[c]});
    return exr::ExrWriter::create(m_name, std::move(header), channels);
}

bool SpectralExrOutput::write_scanline(int y, int z, OIIO::TypeDesc format, const void* data,
                                       OIIO::stride_t xstride) {
    return write_scanlines(y, y + 1, z, format, data, xstride, OIIO::AutoStride);
}

bool SpectralExrOutput::write_scanlines(int ybegin, int yend, int z, OIIO::TypeDesc format, const void* data,
                                        OIIO::stride_t xstride, OIIO::stride_t ystride) {
    if (ybegin != m_next_row || yend <= ybegin || yend > m_spec.y + m_spec.height) {
        errorfmt("rows {} to {} were given, expected row {} next", ybegin, yend - 1, m_next_row);
        return false;
    }
    try {
        OIIO::stride_t zstride = OIIO::AutoStride;
        m_spec.auto_stride(xstride, ystride, zstride, format, m_spec.nchannels, m_spec.width, yend - ybegin);
        const void* const native =
            to_native_rectangle(m_spec.x, m_spec.x + m_spec.width, ybegin, yend, z, z + 1, format, data,
                                xstride, ystride, zstride, m_scratch);
        const auto result = write_native_rows(static_cast<const std::byte*>(native), yend - ybegin);
        if (!result)
            return fail_with(result.error());
    } catch (const std::exception& error) {
        return fail_with({ErrorCode::Io, error.what(), m_name});
    }
    m_next_row = yend;
    return true;
}

Result<void> SpectralExrOutput::write_native_rows(const std::byte* rows, int row_count) {
    const auto row_bytes = static_cast<std::ptrdiff_t>(m_spec.scanline_bytes(true));
    if (m_preview) {
        m_held.insert(m_held.end(), rows, rows + row_count * row_bytes);
        return {};
    }
    const auto pixel_bytes = static_cast<std::ptrdiff_t>(m_spec.pixel_bytes(true));
    std::vector<exr::ChannelRows> channels;
    for (const std::ptrdiff_t offset : m_offsets)
        channels.push_back({rows + offset, pixel_bytes, row_bytes});
    return write_planes(row_count, channels);
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
    m_held = std::vector<std::byte>();
    m_source_samples.clear();
    return ok;
}

Result<void> SpectralExrOutput::finish() {
    if (m_preview) {
        if (m_next_row != m_spec.y + m_spec.height)
            return fail(ErrorCode::Io, "rows from " + std::to_string(m_next_row) + " on were never written");
        OSIO_CHECK_OK(write_held_rows(!drop_stale_preview()));
    }
    return m_writer->finish(m_spec.get_int_attribute(kFsyncAttribute) != 0 ? files::Durability::Stored
                                                                           : files::Durability::Handed);
}

bool SpectralExrOutput::is_preview(std::size_t channel) const {
    return m_preview &&
           std::find(m_preview->rgb.begin(), m_preview->rgb.end(), channel) != m_preview->rgb.end();
}

bool SpectralExrOutput::drop_stale_preview() {
    const auto pixel_bytes = static_cast<std::ptrdiff_t>(m_spec.pixel_bytes(true));
    PlanarBlock held{0, m_spec.height, m_spec.width, {}};
    for (std::size_t c = 0; c < m_types.size(); ++c)
        held.planes.push_back({m_held.data() + m_offsets[c], m_types[c], pixel_bytes});
    const auto samples = preview_samples(*m_preview, held);
    if (preview_matches(m_source_samples, samples))
        return false;
    // A host has no place for a warning of a writer that succeeds.
    std::fprintf(stderr, "osio: warning: R, G, B no longer match the bands and are left out of the "
                         "spectral file\n");
    return true;
}

Result<void> SpectralExrOutput::write_held_rows(bool with_preview) {
    OSIO_TRY(m_writer, make_writer(with_preview));
    const auto pixel_bytes = static_cast<std::ptrdiff_t>(m_spec.pixel_bytes(true));
    std::vector<exr::ChannelRows> channels;
    for (std::size_t c = 0; c < m_offsets.size(); ++c)
        if (with_preview || !is_preview(c))
            channels.push_back({m_held.data() + m_offsets[c], pixel_bytes,
                                static_cast<std::ptrdiff_t>(m_spec.scanline_bytes(true))});
    return write_planes(m_spec.height, channels);
}

Result<void> SpectralExrOutput::write_planes(int row_count, const std::vector<exr::ChannelRows>& channels) {
    HostRunner runner(threads(), static_cast<std::size_t>(row_count));
    return m_writer->write_rows(row_count, channels, &runner);
}

bool SpectralExrOutput::fail_with(const Error& error) {
    errorfmt("{}", error.text());
    return false;
}

}  // namespace osio::plugin
