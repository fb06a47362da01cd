// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/exr_metadata.h>
#include <plugins/common/host_rows.h>
#include <plugins/envi.imageio/input.h>

#include <formats/envi/raw_rows.h>
#include <formats/files/text_file.h>

#include <osio/layout/presentation.h>

#include <exception>
#include <mutex>

namespace osio::plugin {

namespace {

OIIO::TypeDesc host_type(envi::DataType type) {
    using envi::DataType;
    switch (type) {
    case DataType::Uint8: return OIIO::TypeDesc::UINT8;
    case DataType::Int16: return OIIO::TypeDesc::INT16;
    case DataType::Int32: return OIIO::TypeDesc::INT32;
    case DataType::Float: return OIIO::TypeDesc::FLOAT;
    case DataType::Double: return OIIO::TypeDesc::DOUBLE;
    case DataType::Uint16: return OIIO::TypeDesc::UINT16;
    case DataType::Uint32: return OIIO::TypeDesc::UINT32;
    case DataType::Int64: return OIIO::TypeDesc::INT64;
    case DataType::Uint64: break;
    }
    return OIIO::TypeDesc::UINT64;
}

/// The header's fields that say what unscaled numbers mean, which the part's attributes leave out.
void add_scaling(const envi::EnviHeader& header, OIIO::ImageSpec& spec) {
    for (const envi::Field& field : header.fields.fields)
        for (const char* key : {"interleave", "reflectance scale factor", "data gain values",
                                "data offset values", "data ignore value", "bbl"})
            if (field.key == key)
                spec.attribute(std::string(envi::kAttributePrefix) + key, field.value);
}

}  // namespace

bool EnviInput::valid_file(const std::string& filename) const {
    try {
        const auto header = envi::find_header(filename);
        if (!header)
            return false;
        const auto text = files::read_text(*header);
        return text && envi::parse_header(*text).has_value();
    } catch (const std::exception&) {
        return false;
    }
}

bool EnviInput::open(const std::string& name, OIIO::ImageSpec& spec) {
    close();
    try {
        auto file = envi::EnviFile::open(name);
        if (!file) {
            errorfmt("{}", file.error().text());
            return false;
        }
        m_file = std::move(*file);
        const image::Part& part = m_file->parts()[0];
        m_spec = OIIO::ImageSpec(part.data_window.width(), part.data_window.height(),
                                 static_cast<int>(part.channels.size()), host_type(m_file->header().type));
        m_spec.channelnames.clear();
        for (const PresentedChannel& channel : present_channels(part.layout, BandNames::CommaFree)) {
            m_spec.channelnames.push_back(channel.name);
            m_bands.push_back(channel.channel);
        }
        m_spec.alpha_channel = m_spec.z_channel = -1;
        add_metadata(part.header, m_spec);
        add_scaling(m_file->header(), m_spec);
        m_spec.attribute("oiio:ColorSpace", "Linear");
    } catch (const std::exception& error) {
        close();
        errorfmt("{}: {}", name, error.what());
        return false;
    }
    spec = m_spec;
    return true;
}

bool EnviInput::close() {
    m_file.reset();
    m_bands.clear();
    m_spec = OIIO::ImageSpec();
    return true;
}

bool EnviInput::read_native_scanline(int subimage, int miplevel, int y, int z, void* data) {
    return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
}

bool EnviInput::read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int, void* data) {
    const lock_guard lock(*this);
    if (!m_file || subimage != 0 || miplevel != 0)
        return false;
    return read_host_rows(*this, m_spec, ybegin, yend, [&](RowRange rows) {
        return envi::read_raw_rows(*m_file, rows, m_bands, static_cast<std::byte*>(data));
    });
}

}  // namespace osio::plugin
