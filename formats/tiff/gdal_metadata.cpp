// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/gdal_metadata.h>

#include <osio/base/text.h>

#include <pugixml.hpp>

namespace osio::tiff {

Result<std::vector<GdalItem>> parse_gdal_metadata(std::string_view xml) {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(
        xml.data(), xml.size(), pugi::parse_default | pugi::parse_ws_pcdata_single, pugi::encoding_utf8);
    if (!parsed)
        return fail(ErrorCode::Damaged,
                    "its GDAL metadata (tag 42112) are no XML: " + std::string(parsed.description()) +
                        " at byte " + std::to_string(parsed.offset));
    const pugi::xml_node root = document.child("GDALMetadata");
    if (!root)
        return fail(ErrorCode::Damaged, "its GDAL metadata (tag 42112) have no element GDALMetadata");
    std::vector<GdalItem> out;
    for (const pugi::xml_node node : root.children("Item")) {
        if (node.find_child([](const pugi::xml_node& child) { return child.type() == pugi::node_element; }))
            continue;
        GdalItem item;
        item.name = node.attribute("name").value();
        item.value = node.child_value();
        item.domain = node.attribute("domain").value();
        item.role = node.attribute("role").value();
        if (const pugi::xml_attribute sample = node.attribute("sample")) {
            const auto number = parse_int(sample.value());
            if (!number || *number < 0)
                return fail(ErrorCode::Damaged, "its GDAL metadata (tag 42112) have an item of sample \"" +
                                                    std::string(sample.value()).substr(0, 40) +
                                                    "\", expected a number from 0 on");
            item.sample = static_cast<std::size_t>(*number);
        }
        out.push_back(std::move(item));
    }
    return out;
}

std::string gdal_metadata_text(std::span<const GdalItem> items) {
    std::string out = "<GDALMetadata>\n";
    const auto attribute = [&out](const char* name, const std::string& value) {
        if (!value.empty())
            out += std::string(" ") + name + "=\"" + escaped_xml(value) + "\"";
    };
    for (const GdalItem& item : items) {
        out += "  <Item";
        attribute("name", item.name);
        if (item.sample)
            attribute("sample", std::to_string(*item.sample));
        attribute("domain", item.domain);
        attribute("role", item.role);
        out += ">" + escaped_xml(item.value) + "</Item>\n";
    }
    return out + "</GDALMetadata>\n";
}

}  // namespace osio::tiff
