// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/header_output.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <string_view>

namespace osio::exr {

namespace {

/// Names of more bytes need a flag in the file's version field (OpenEXR's file layout, "Version field").
constexpr std::size_t kShortName = 31;

bool has_long_names(const Imf::Header& header) {
    for (auto a = header.begin(); a != header.end(); ++a)
        if (std::string_view(a.name()).size() > kShortName ||
            std::string_view(a.attribute().typeName()).size() > kShortName)
            return true;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        if (std::string_view(c.name()).size() > kShortName)
            return true;
    return false;
}

}  // namespace

void write_headers(Imf::OStream& stream, std::span<const Imf::Header> headers) {
    const bool several = headers.size() > 1;
    for (const Imf::Header& header : headers)
        header.sanityCheck(header.hasTileDescription(), several);
    write_number(stream, std::uint32_t{Imf::MAGIC});
    int flags = several                                ? Imf::MULTI_PART_FILE_FLAG
                : headers.front().hasTileDescription() ? Imf::TILED_FLAG
                                                       : 0;
    if (std::any_of(headers.begin(), headers.end(), has_long_names))
        flags |= Imf::LONG_NAMES_FLAG;
    write_number(stream, static_cast<std::uint32_t>(Imf::EXR_VERSION | flags));
    for (const Imf::Header& header : headers)
        header.writeTo(stream, header.hasTileDescription());
    if (several)
        write_number(stream, std::uint8_t{0});
}

}  // namespace osio::exr
