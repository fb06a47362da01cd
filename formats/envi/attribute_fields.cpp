// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/attribute_fields.h>
#include <formats/image/limits.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osio::envi {

namespace {

constexpr std::string_view kForeign = "exr ";

bool fits_a_key(std::string_view text) {
    return !text.empty() && trim(text) == text && text.find_first_of("=\n\r") == std::string_view::npos;
}

std::optional<std::string> text_of(const Imf::Attribute& attribute) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
        return text->value();
    if (const auto* number = dynamic_cast<const Imf::IntAttribute*>(&attribute))
        return std::to_string(number->value());
    std::optional<double> value;
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute))
        value = static_cast<double>(number->value());
    if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&attribute))
        value = number->value();
    return value && std::isfinite(*value) ? std::optional(format_double(*value)) : std::nullopt;
}

/// True where the attribute has one of our types and the text is one of its values.
bool insert_typed(std::string_view type, const std::string& name, const std::string& value,
                  Imf::Header& header) {
    if (type == "string") {
        header.insert(name, Imf::StringAttribute(value));
        return true;
    }
    const auto number = parse_double(value);
    const auto whole = parse_int(value);
    if (type == "int" && whole)
        header.insert(name, Imf::IntAttribute(*whole));
    else if (type == "float" && number && std::abs(*number) <= double{std::numeric_limits<float>::max()})
        header.insert(name, Imf::FloatAttribute(static_cast<float>(*number)));
    else if (type == "double" && number)
        header.insert(name, Imf::DoubleAttribute(*number));
    else
        return false;
    return true;
}

}  // namespace

std::optional<Field> field_of(const std::string& name, const Imf::Attribute& attribute) {
    const auto value = text_of(attribute);
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
        // Empty names end a header; OpenEXR refuses longer ones.
        if (space != std::string_view::npos && space + 1 < rest.size() &&
            rest.size() - space - 1 <= image::kMostNameBytes) {
            const std::string name(rest.substr(space + 1));
            const bool fresh = header.find(name) == header.end() ||
                               header.find(name).attribute().typeName() == std::string(rest.substr(0, space));
            if (fresh && insert_typed(rest.substr(0, space), name, field.value, header))
                return;
        }
    }
    const std::string name = std::string(kAttributePrefix) + field.key;
    if (name.size() <= image::kMostNameBytes && name.find('\0') == std::string::npos)
        header.insert(name, Imf::StringAttribute(field.value));
}

bool counts_bands(std::string_view key) {
    constexpr std::array<std::string_view, 4> kByBand{
        "default bands", "band names", "data reflectance gain values", "data reflectance offset values"};
    return std::find(kByBand.begin(), kByBand.end(), key) != kByBand.end();
}

}  // namespace osio::envi
