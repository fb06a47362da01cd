// SPDX-License-Identifier: Apache-2.0
#include <plugins/ocio/config.h>
#include <plugins/ocio/transform.h>

#include <osio/base/text.h>

#include <array>

namespace osio::ocio {

namespace {

bool is_display(const OCIO::ConstColorSpaceRcPtr& space) {
    return space->getReferenceSpaceType() == OCIO::REFERENCE_SPACE_DISPLAY;
}

/// A shared view says with this that its colour space is called as the display.
constexpr std::string_view kNamedAsDisplay = "<USE_DISPLAY_NAME>";

}  // namespace

std::string OcioConfig::name() const {
    const char* const name = m_config->getName();
    return name == nullptr ? "" : name;
}

std::vector<ConfigName> OcioConfig::names() const {
    std::vector<ConfigName> out;
    for (int i = 0; i < m_config->getNumColorSpaces(); ++i) {
        const auto space = m_config->getColorSpace(m_config->getColorSpaceNameByIndex(i));
        if (!space)
            continue;
        ConfigName entry{space->getName(), is_display(space) ? "display" : "scene", {}};
        if (space->isData())
            entry.kind = "data";
        for (std::size_t alias = 0; alias < space->getNumAliases(); ++alias)
            entry.aliases.emplace_back(space->getAlias(alias));
        out.push_back(std::move(entry));
    }
    for (int i = 0; i < m_config->getNumRoles(); ++i)
        out.push_back({m_config->getRoleName(i), "role", {m_config->getRoleColorSpace(i)}});
    for (const View& view : views())
        out.push_back({view.display + "/" + view.view, "view", {}});
    return out;
}

std::vector<OcioConfig::View> OcioConfig::views() const {
    std::vector<View> out;
    for (int d = 0; d < m_config->getNumDisplays(); ++d) {
        const char* const display = m_config->getDisplay(d);
        for (int v = 0; v < m_config->getNumViews(display); ++v) {
            const char* const view = m_config->getView(display, v);
            std::string space = m_config->getDisplayViewColorSpaceName(display, view);
            if (space == kNamedAsDisplay)
                space = display;
            out.push_back({display, view, std::move(space)});
        }
    }
    return out;
}

std::optional<OcioConfig::View> OcioConfig::find_view(std::string_view name) const {
    for (View& view : views())
        if (iequals(view.display + "/" + view.view, name))
            return std::move(view);
    return std::nullopt;
}

Result<OutputSpace> OcioConfig::find(std::string_view name) const {
    try {
        if (const auto space = m_config->getColorSpace(std::string(name).c_str()))
            return to_space(space);
        if (const auto view = find_view(name))
            return to_view(*view);
    } catch (const std::exception& error) {
        return refuse("OpenColorIO makes no way to \"" + std::string(name) + "\": " + error.what());
    }
    return fail(ErrorCode::UnknownName, "has nothing called \"" + std::string(name) + "\"", m_file);
}

Result<OutputSpace> OcioConfig::to_space(const OCIO::ConstColorSpaceRcPtr& space) const {
    const std::string name = space->getName();
    if (space->isData())
        return refuse("\"" + name +
                      "\" is for data, which no colour conversion touches; name a colour space");
    const bool display = is_display(space);
    OSIO_TRY(const std::string from,
             interchange(display ? OCIO::ROLE_INTERCHANGE_DISPLAY : OCIO::ROLE_INTERCHANGE_SCENE));
    OSIO_TRY(OutputSpace out, find_output_space(display ? "xyz_d65" : "aces2065_1"));
    out.id = std::string(kConfigPrefix) + name;
    out.color_space = name;
    out.transform =
        std::make_shared<CpuTransform>(m_config->getProcessor(from.c_str(), name.c_str()), source(from));
    return out;
}

Result<OutputSpace> OcioConfig::to_view(const View& view) const {
    const std::string name = view.display + "/" + view.view;
    const auto space = m_config->getColorSpace(view.color_space.c_str());
    if (space && space->isData())
        return refuse("the view \"" + name + "\" shows data as it is; name a view that shows colour");
    OSIO_TRY(const std::string from, interchange(OCIO::ROLE_INTERCHANGE_SCENE));
    const auto transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(from.c_str());
    transform->setDisplay(view.display.c_str());
    transform->setView(view.view.c_str());
    OSIO_TRY(OutputSpace out, find_output_space("aces2065_1"));
    out.id = std::string(kConfigPrefix) + name;
    out.color_space = view.color_space;
    out.transform = std::make_shared<CpuTransform>(m_config->getProcessor(transform), source(from));
    return out;
}

Result<std::string> OcioConfig::interchange(const char* role) const {
    if (const auto space = m_config->getColorSpace(role); space && m_config->hasRole(role))
        return std::string(space->getName());
    const bool scene = std::string_view(role) == OCIO::ROLE_INTERCHANGE_SCENE;
    return refuse(std::string("has no role ") + role + ", which says where " +
                  (scene ? "ACES2065-1" : "CIE XYZ under D65") +
                  " enters it; add it to the config's roles, or collapse to a space of ours (osiotool list "
                  "spaces) and convert from there");
}

TransformSource OcioConfig::source(std::string from) const {
    return {m_file, name(), m_config->getCacheID(), std::move(from), {}};
}

tl::unexpected<Error> OcioConfig::refuse(const std::string& why) const {
    return fail(ErrorCode::Usage, why, m_file);
}

}  // namespace osio::ocio
