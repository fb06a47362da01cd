// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/part_bands.h>

#include <osio/layout/part_layout.h>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

namespace osio::exr {

namespace {

/// The shortest decimal that reads back as the same number: a float of 5.5e-7 is no 5.49999997e-7.
template <class Number>
std::string shortest(Number value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() ? std::string(text.data(), end) : std::string();
}

HeaderAttributes attributes_of(const Imf::Header& header) {
    HeaderAttributes out{image::text_attributes(header), {}};
    for (auto a = header.begin(); a != header.end(); ++a) {
        if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&a.attribute()))
            out.numbers.emplace(a.name(), shortest(number->value()));
        else if (const auto* wide = dynamic_cast<const Imf::DoubleAttribute*>(&a.attribute()))
            out.numbers.emplace(a.name(), shortest(wide->value()));
    }
    return out;
}

Result<PartLayout> layout_of(const image::Part& part, const OpenWords& words) {
    std::vector<std::string> names;
    for (const image::Channel& channel : part.channels)
        names.push_back(channel.name);
    return read_part_layout(names, attributes_of(part.header), words);
}

void take(PartLayout layout, image::Part& part) {
    for (const std::string& name : layout.replaced)
        part.header.erase(name);
    for (const auto& [name, value] : layout.attributes)
        part.header.insert(name, Imf::StringAttribute(value));
    part.layout = std::move(layout.layout);
    part.metadata = read_spectral_metadata(part.layout, image::text_attributes(part.header));
}

}  // namespace

Result<void> understand_bands(std::vector<image::Part>& parts, const OpenWords& words) {
    std::vector<Result<PartLayout>> layouts;
    std::optional<Error> first;
    bool fits = false;
    for (const image::Part& part : parts) {
        layouts.push_back(layout_of(part, words));
        fits = fits || layouts.back();
        if (!layouts.back() && !first)
            first = layouts.back().error();
    }
    if (!fits && first)
        return tl::unexpected(*first);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (layouts[i]) {
            take(std::move(*layouts[i]), parts[i]);
            continue;
        }
        OSIO_TRY(PartLayout by_name, layout_of(parts[i], {}));
        by_name.layout.warnings.push_back(layouts[i].error().text() + ": this part is read without the word");
        take(std::move(by_name), parts[i]);
    }
    return {};
}

}  // namespace osio::exr
