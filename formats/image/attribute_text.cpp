// SPDX-License-Identifier: Apache-2.0
#include <formats/image/attribute_text.h>
#include <formats/image/limits.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cmath>
#include <limits>

namespace osio::image {

namespace {

/// Empty names end a header; OpenEXR refuses longer ones.
bool fits_a_name(const std::string& name) {
    return !name.empty() && name.size() <= kMostNameBytes && name.find('\0') == std::string::npos;
}

}  // namespace

std::optional<std::string> attribute_text(const Imf::Attribute& attribute) {
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

bool insert_typed(std::string_view type, const std::string& name, const std::string& value,
                  Imf::Header& header) {
    if (!fits_a_name(name) ||
        (header.find(name) != header.end() && header.find(name).attribute().typeName() != std::string(type)))
        return false;
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

void insert_text(const std::string& name, const std::string& value, Imf::Header& header) {
    if (fits_a_name(name) && header.find(name) == header.end())
        header.insert(name, Imf::StringAttribute(value));
}

}  // namespace osio::image
