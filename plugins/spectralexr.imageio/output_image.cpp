// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/exr_metadata.h>
#include <plugins/spectralexr.imageio/output_image.h>
#include <plugins/spectralexr.imageio/spec.h>

#include <formats/exr/exr_file.h>
#include <formats/exr/output_header.h>
#include <formats/exr/spectral_header.h>
#include <formats/image/colour_attributes.h>
#include <formats/image/header_attributes.h>
#include <formats/image/preview_plan.h>

#include <osio/collapse/kernel.h>
#include <osio/layout/presentation.h>

#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
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

/// The set that a picture is made of: without a root where there is one, radiance before reflectance.
const SpectralSet* pictured_set(const ChannelLayout& layout) {
    const SpectralSet* out = nullptr;
    for (const SpectralSet& set : layout.sets)
        if (!set.bands.empty() && (set.family == Family::S0 || set.family == Family::T) &&
            (out == nullptr || (set.root.empty() && !out->root.empty())))
            out = &set;
    return out;
}

}  // namespace

Result<OutputImage> OutputImage::create(const OIIO::ImageSpec& spec, bool needs_bands) {
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep)
        return fail(ErrorCode::Unsupported, "a spectral file holds flat images of at least 1x1 pixels");
    OutputImage out(spec);
    OSIO_CHECK_OK(out.name_channels(needs_bands));
    out.choose_types();
    if (const std::string light = spec.get_string_attribute(kPreviewAttribute);
        !light.empty() && out.has_bands()) {
        OSIO_CHECK_OK(out.plan_picture(light));
        return out;
    }
    out.m_preview = PreviewChannels::find(out.m_layout);
    if (out.m_preview) {
        // Before anything is written: the source may be the file that is about to be replaced.
        out.m_source_samples =
            preview_samples_of_file(spec.get_string_attribute(kSourceAttribute),
                                    static_cast<std::size_t>(spec.get_int_attribute(kSourcePartAttribute)));
        out.m_held.reserve(out.m_spec.image_bytes(true));
    }
    return out;
}

Result<void> OutputImage::name_channels(bool needs_bands) {
    m_layout = parse_channel_layout(layout_names(m_spec.channelnames), DecimalMark::Comma);
    const auto& names = m_layout.channel_names;
    if (names.size() != static_cast<std::size_t>(m_spec.nchannels) ||
        std::set<std::string>(names.begin(), names.end()).size() != names.size() || m_layout.find_channel(""))
        return fail(ErrorCode::Usage, "every channel needs a name of its own");
    if (needs_bands && m_layout.sets.empty())
        return fail(ErrorCode::NotSpectral,
                    "none of " + std::to_string(names.size()) +
                        " channels is a band; expected names such as T.450nm or S0.550.5nm, or an "
                        "output that ends in .exr");
    return {};
}

void OutputImage::choose_types() {
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
}

Result<void> OutputImage::plan_picture(const std::string& light) {
    const SpectralSet* const set = pictured_set(m_layout);
    if (set == nullptr)
        return fail(ErrorCode::Unsupported, "there is no set S0 or T to make R, G, B of");
    const std::string root = set->root.empty() ? "" : set->root + ".";
    m_picture_names = {root + "R", root + "G", root + "B"};
    const auto metadata = read_spectral_metadata(m_layout, image::text_attributes(header()));
    OSIO_TRY(m_picture, image::preview_plan(*set, metadata, light));
    return {};
}

bool OutputImage::is_written(std::size_t channel) const {
    if (m_picture)
        return std::find(m_picture_names.begin(), m_picture_names.end(), m_layout.channel_names[channel]) ==
               m_picture_names.end();
    return !m_stale ||
           std::find(m_preview->rgb.begin(), m_preview->rgb.end(), channel) == m_preview->rgb.end();
}

Imf::Header OutputImage::header() const {
    Imf::Header out = header_of_windows(m_spec);
    set_compression(m_spec, out);
    if (m_spec.tile_width > 0 && m_spec.tile_height > 0)
        out.setTileDescription(Imf::TileDescription(static_cast<unsigned>(m_spec.tile_width),
                                                    static_cast<unsigned>(m_spec.tile_height)));
    insert_metadata(m_spec, out);
    image::erase_attributes({image::attribute::kRecipe, image::attribute::kPlan, image::attribute::kWarnings,
                             kSourceAttribute, kSourcePartAttribute, kFsyncAttribute, kPreviewAttribute},
                            out);
    if (has_bands())
        exr::complete_spectral_header(m_layout, out);
    if (m_picture)
        image::insert_preview_attributes(*m_picture, out);
    if (m_stale)
        image::erase_attributes({image::attribute::kChromaticities, image::attribute::kPreviewRecipe,
                                 std::string(attribute::kExposureValue)},
                                out);
    return out;
}

exr::OutputPart OutputImage::part() const {
    exr::OutputPart out{header(), {}};
    for (std::size_t c = 0; c < m_types.size(); ++c)
        if (is_written(c))
            out.channels.push_back({m_layout.channel_names[c], m_types[c]});
    if (m_picture)
        for (const std::string& name : m_picture_names)
            out.channels.push_back({name, SampleType::Float});
    return out;
}

std::vector<exr::ChannelRows> OutputImage::channels_of(const std::byte* rows, int row_count) {
    const auto row_bytes = static_cast<std::ptrdiff_t>(m_spec.scanline_bytes(true));
    const auto pixel_bytes = static_cast<std::ptrdiff_t>(m_spec.pixel_bytes(true));
    std::vector<exr::ChannelRows> out;
    for (std::size_t c = 0; c < m_offsets.size(); ++c)
        if (is_written(c))
            out.push_back({rows + m_offsets[c], pixel_bytes, row_bytes});
    if (!m_picture)
        return out;
    const std::size_t samples = static_cast<std::size_t>(row_count) * static_cast<std::size_t>(m_spec.width);
    std::vector<BandView> bands;
    for (const Band& band : m_picture->bands)
        bands.push_back({rows + m_offsets[band.channel], m_types[band.channel], pixel_bytes});
    std::array<float*, 3> to{};
    for (std::size_t c = 0; c < 3; ++c) {
        m_picture_rows[c].resize(samples);
        to[c] = m_picture_rows[c].data();
        out.push_back({reinterpret_cast<const std::byte*>(to[c]), sizeof(float),
                       static_cast<std::ptrdiff_t>(sizeof(float)) * m_spec.width});
    }
    collapse_run(bands, m_picture->weights, samples, to);
    return out;
}

void OutputImage::hold(const std::byte* rows, int row_count) {
    m_held.insert(m_held.end(), rows,
                  rows + row_count * static_cast<std::ptrdiff_t>(m_spec.scanline_bytes(true)));
}

bool OutputImage::drop_stale_preview() {
    const auto pixel_bytes = static_cast<std::ptrdiff_t>(m_spec.pixel_bytes(true));
    PlanarBlock held{0, m_spec.height, m_spec.width, {}};
    for (std::size_t c = 0; c < m_types.size(); ++c)
        held.planes.push_back({m_held.data() + m_offsets[c], m_types[c], pixel_bytes});
    m_stale = !preview_matches(m_source_samples, preview_samples(*m_preview, held));
    return m_stale;
}

}  // namespace osio::plugin
