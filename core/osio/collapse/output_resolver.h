// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/request.h>
#include <osio/colour/rgb_space.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// A name that a colour config has for something that pixels can be converted to.
struct ConfigName {
    std::string name;  ///< of a view: "DISPLAY/VIEW"
    std::string kind;  ///< "scene", "display", "data", "role", "view"
    std::vector<std::string> aliases;
};

/// A colour config, opened. Core knows of it no more than this.
class ColourConfig {
  public:
    virtual ~ColourConfig() = default;

    [[nodiscard]] virtual std::string file() const = 0;
    /// What it calls itself; may be empty.
    [[nodiscard]] virtual std::string name() const = 0;

    /// Its active colour spaces, its roles, its views, in this order.
    [[nodiscard]] virtual std::vector<ConfigName> names() const = 0;

    /// The space of that name, alias or role, or the view of a display, in any case; its `id` is
    /// "ocio:" and the config's own spelling. UnknownName where there is none of that name; Usage where
    /// pixels cannot be converted to it, with the reason.
    [[nodiscard]] virtual Result<OutputSpace> find(std::string_view name) const = 0;
};

/// Opens the config at a path, or, where that is empty, the one that the environment names: null where
/// it names none.
using ConfigLoader = std::function<Result<std::shared_ptr<const ColourConfig>>(const std::string& path)>;

/// Before a name, `ocio:` takes the config's meaning even where we have the name too.
inline constexpr std::string_view kConfigPrefix = "ocio:";

/// Gives request.to its meaning where its name is none of ours: a config is opened only then. A name
/// that nobody has is UnknownName, with the nearest of ours and the config's.
[[nodiscard]] Result<void> resolve_output(CollapseRequest& request, const ConfigLoader& load_config);

}  // namespace osio
