// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/header_bytes.h>
#include <formats/exr/reserved_text.h>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>

namespace osio::exr {

void reserve_text(const std::string& name, std::size_t bytes, Imf::Header& header) {
    header.insert(name, Imf::StringAttribute(std::string(bytes, ' ')));
}

Result<void> write_reserved_text(const std::string& path, std::size_t part, std::string_view name,
                                 std::string text) {
    OSIO_TRY(const files::RawFile file, files::RawFile::open(path));
    std::string bytes;
    OSIO_TRY(const RawHeaders headers, read_raw_headers(file, bytes));
    const RawHeader& header = headers.parts.at(part);
    const auto place = std::find_if(header.begin(), header.end(),
                                    [name](const RawAttribute& attribute) { return attribute.name == name; });
    if (place == header.end() || place->value.size() < text.size())
        return fail(ErrorCode::Io, "was not written as it was meant: no place for " + std::string(name));
    text.resize(place->value.size(), ' ');
    return files::overwrite(path, place->value_at, text);
}

}  // namespace osio::exr
