// SPDX-License-Identifier: Apache-2.0
#include <formats/tiff/item_names.h>

#include <osio/base/text.h>

namespace osio::tiff {

std::string normal_name(std::string_view name) {
    std::string out = to_lower(trim(name));
    std::replace(out.begin(), out.end(), ' ', '_');
    return out;
}

std::vector<std::string> list_of(std::string_view text) {
    text = trim(text);
    if (text.starts_with('{') || text.starts_with('['))
        text.remove_prefix(1);
    if (text.ends_with('}') || text.ends_with(']'))
        text.remove_suffix(1);
    const char* const separators = text.find_first_of(",;") == std::string_view::npos ? " \t\r\n" : ",;";
    std::vector<std::string> out;
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of(separators), text.size());
        if (const auto piece = trim(text.substr(0, end)); !piece.empty())
            out.emplace_back(piece);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

bool says_something(const GdalItem& item) {
    const std::string name = normal_name(item.name);
    return (item.domain.empty() || iequals(item.domain, "ENVI")) &&
           (is_one_of(name, kWavelengthNames) || is_one_of(name, kUnitNames) ||
            is_one_of(name, kQuantityNames) || name == "fwhm" || name == "bbl" ||
            name == "reflectance_scale_factor" || name.starts_with("band_"));
}

}  // namespace osio::tiff
