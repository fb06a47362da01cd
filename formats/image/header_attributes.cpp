// SPDX-License-Identifier: Apache-2.0
#include <formats/image/header_attributes.h>
#include <formats/image/spectral_image.h>

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>

#include <array>
#include <charconv>
#include <string>

namespace osio::image {

namespace {

/// The shortest decimal that reads back as the same number: a float of 5.5e-7 is no 5.49999997e-7.
template <class Number>
std::string shortest(Number value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() ? std::string(text.data(), end) : std::string();
}

}  // namespace

HeaderAttributes header_attributes(const Imf::Header& header) {
    HeaderAttributes out{text_attributes(header), {}};
    for (auto a = header.begin(); a != header.end(); ++a) {
        if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&a.attribute()))
            out.numbers.emplace(a.name(), shortest(number->value()));
        else if (const auto* wide = dynamic_cast<const Imf::DoubleAttribute*>(&a.attribute()))
            out.numbers.emplace(a.name(), shortest(wide->value()));
    }
    return out;
}

void erase_attributes(const std::set<std::string, std::less<>>& names, Imf::Header& header) {
    Imf::Header kept(header.displayWindow(), header.dataWindow());
    bool erased = false;
    for (auto a = header.begin(); a != header.end(); ++a)
        if (names.contains(a.name()))
            erased = true;
        else
            kept.insert(a.name(), a.attribute());
    if (!erased)
        return;
    kept.zipCompressionLevel() = header.zipCompressionLevel();
    kept.dwaCompressionLevel() = header.dwaCompressionLevel();
    header = kept;
}

}  // namespace osio::image
