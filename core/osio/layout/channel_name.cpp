// SPDX-License-Identifier: Apache-2.0
#include <osio/layout/channel_name.h>

#include <array>

namespace osio {

namespace {

constexpr std::array<std::pair<std::string_view, Family>, 5> kFamilies{
    {{"S0", Family::S0}, {"S1", Family::S1}, {"S2", Family::S2}, {"S3", Family::S3}, {"T", Family::T}}};

/// `family "."` at the start of text, which is advanced past it.
std::optional<Family> take_family(std::string_view& text) {
    for (const auto& [name, family] : kFamilies) {
        if (text.starts_with(name) && text.substr(name.size()).starts_with('.')) {
            text.remove_prefix(name.size() + 1);
            return family;
        }
    }
    return std::nullopt;
}

std::optional<ChannelName> parse_without_root(std::string_view text, DecimalMark mark) {
    const auto family = take_family(text);
    if (!family)
        return std::nullopt;
    const auto wavelength = take_wavelength_nm(text, mark);
    if (!wavelength)
        return std::nullopt;
    ChannelName out{{}, *family, *wavelength, std::nullopt};
    if (text.empty())
        return out;
    if (*family != Family::T || !text.starts_with('.'))
        return std::nullopt;
    out.emitted_nm = parse_wavelength_nm(text.substr(1), mark);
    if (!out.emitted_nm)
        return std::nullopt;
    return out;
}

/// Calls visit(root, rest) for each way to cut the name at a dot, the empty root first.
template <class Visit>
void for_each_root(std::string_view name, Visit visit) {
    if (visit(std::string_view{}, name))
        return;
    for (auto dot = name.find('.'); dot != std::string_view::npos; dot = name.find('.', dot + 1))
        if (dot > 0 && visit(name.substr(0, dot), name.substr(dot + 1)))
            return;
}

}  // namespace

std::string_view family_name(Family family) {
    for (const auto& [name, known] : kFamilies)
        if (known == family)
            return name;
    return {};
}

std::optional<ChannelName> parse_channel_name(std::string_view name, DecimalMark mark) {
    std::optional<ChannelName> found;
    for_each_root(name, [&](std::string_view root, std::string_view rest) {
        found = parse_without_root(rest, mark);
        if (found)
            found->root = root;
        return found.has_value();
    });
    return found;
}

bool looks_like_a_band(std::string_view name) {
    if (parse_channel_name(name, DecimalMark::Comma))
        return false;
    bool found = false;
    for_each_root(name, [&](std::string_view, std::string_view rest) {
        const bool family = take_family(rest).has_value();
        found = family && !rest.empty() &&
                (rest[0] == ',' || rest[0] == '.' || (rest[0] >= '0' && rest[0] <= '9'));
        return found;
    });
    return found;
}

std::string format_channel_name(const ChannelName& name, DecimalMark mark) {
    std::string out = name.root.empty() ? std::string() : name.root + ".";
    out += family_name(name.family);
    out += '.' + format_wavelength(name.wavelength_nm, mark);
    if (name.emitted_nm)
        out += '.' + format_wavelength(*name.emitted_nm, mark);
    return out;
}

}  // namespace osio
