// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/attribute_fields.h>
#include <formats/image/attribute_text.h>

#include <osio/base/text.h>

#include <algorithm>
#include <array>

namespace osio::envi {

namespace {

constexpr std::string_view kForeign = "exr ";

bool fits_a_key(std::string_view text) {
    return !text.empty() && trim(text) == text && text.find_first_of("=\n\r") == std::string_view::npos;
}

}  // namespace

std::optional<Field> field_of(const std::string& name, const Imf::Attribute& attribute) {
    const auto value = image::attribute_text(attribute);
    if (!value || value->find('}') != std::string::npos || !fits_a_key(name))
        return std::nullopt;
    if (name.starts_with(kAttributePrefix)) {
        const std::string key = name.substr(kAttributePrefix.size());
        const bool plain = fits_a_key(*value) && value->find_first_of(",{[") == std::string::npos;
        return fits_a_key(key) ? std::optional(Field{normal_key(key), key, *value, !plain}) : std::nullopt;
    }
    const std::string label = std::string(kForeign) + attribute.typeName() + " " + name;
    return Field{normal_key(label), label, *value, true};
}

void insert_field(const Field& field, Imf::Header& header) {
    if (field.label.starts_with(kForeign)) {
        const std::string_view rest = std::string_view(field.label).substr(kForeign.size());
        const auto space = rest.find(' ');
        if (space != std::string_view::npos &&
            image::insert_typed(rest.substr(0, space), std::string(rest.substr(space + 1)), field.value,
                                header))
            return;
    }
    image::insert_text(std::string(kAttributePrefix) + field.key, field.value, header);
}

bool counts_bands(std::string_view key) {
    constexpr std::array<std::string_view, 4> kByBand{
        "default bands", "band names", "data reflectance gain values", "data reflectance offset values"};
    return std::find(kByBand.begin(), kByBand.end(), key) != kByBand.end();
}

}  // namespace osio::envi
