// SPDX-License-Identifier: Apache-2.0
#include <formats/image/attribute_text.h>
#include <formats/tiff/attribute_items.h>
#include <formats/tiff/item_names.h>
#include <formats/tiff/text_tags.h>

#include <algorithm>

namespace osio::tiff {

namespace {

/// XML 1.0 has no control characters but these; others are lost, and a carriage return becomes a line feed.
bool fits_xml(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t';
    });
}

/// Readers of attributes in XML make spaces of line feeds and tabs.
bool fits_xml_name(std::string_view text) {
    return fits_xml(text) && text.find_first_of("\n\t") == std::string_view::npos;
}

}  // namespace

void insert_item(const GdalItem& item, Imf::Header& header) {
    const auto space = item.name.find(' ');
    if (item.domain == kExrDomain && space != std::string::npos &&
        image::insert_typed(item.name.substr(0, space), item.name.substr(space + 1), item.value, header))
        return;
    image::insert_text(std::string(kGdalPrefix) + (item.domain.empty() ? "" : item.domain + ":") + item.name,
                       item.value, header);
}

bool add_attribute(const std::string& name, const Imf::Attribute& attribute, TiffOutput& output) {
    const auto value = image::attribute_text(attribute);
    if (!value || !fits_xml_name(name) || !fits_xml(*value))
        return false;
    if (name.starts_with(kTextPrefix) && find_text_tag(name.substr(kTextPrefix.size()))) {
        output.texts.emplace_back(name.substr(kTextPrefix.size()), *value);
        return !value->empty();
    }
    if (name.starts_with(kGdalPrefix)) {
        std::string rest = name.substr(kGdalPrefix.size());
        const auto colon = rest.find(':');
        GdalItem item{rest.substr(colon == std::string::npos ? 0 : colon + 1),
                      *value,
                      {},
                      colon == std::string::npos ? std::string() : rest.substr(0, colon),
                      {}};
        if (says_something(item))
            return false;
        output.items.push_back(std::move(item));
        return true;
    }
    output.items.push_back(
        {std::string(attribute.typeName()) + " " + name, *value, {}, std::string(kExrDomain), {}});
    return true;
}

}  // namespace osio::tiff
