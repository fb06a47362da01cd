// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/output_resolver.h>

namespace osio {

namespace {

std::string without_prefix(const std::string& name) {
    return to_lower(name).starts_with(kConfigPrefix) ? std::string(trim(name.substr(kConfigPrefix.size())))
                                                     : name;
}

/// Our own names, unless the config's were asked for, and all of the config's.
std::vector<std::string> known_names(const ColourConfig& config, bool forced) {
    std::vector<std::string> names;
    if (!forced)
        names = output_space_names();
    for (const ConfigName& entry : config.names()) {
        names.push_back(entry.name);
        names.insert(names.end(), entry.aliases.begin(), entry.aliases.end());
    }
    return names;
}

}  // namespace

Result<void> resolve_output(CollapseRequest& request, const ConfigLoader& load_config) {
    if (request.config_space.empty())
        return {};
    const std::string name = without_prefix(request.config_space);
    const bool forced = name.size() != request.config_space.size();
    auto config = load_config(request.config);
    if (!config) {
        if (forced || !request.config.empty())
            return tl::unexpected(std::move(config).error());
        Error error = find_output_space(name).error();
        error.what += "; and no colour config was looked at: " + config.error().text();
        return tl::unexpected(std::move(error));
    }
    if (!*config) {
        if (forced)
            return fail(ErrorCode::Usage, "to=" + request.config_space +
                                              " needs a colour config; name one with config=FILE.ocio or in "
                                              "the environment's OCIO");
        return tl::unexpected(find_output_space(name).error());
    }
    auto space = (*config)->find(name);
    if (!space && space.error().code == ErrorCode::UnknownName)
        return fail(ErrorCode::UnknownName, "no output space is called \"" + name + "\", and nothing in " +
                                                (*config)->file() +
                                                suggestion(name, known_names(**config, forced)));
    if (!space)
        return tl::unexpected(std::move(space).error());
    request.to = std::move(*space);
    request.config_space.clear();
    return {};
}

}  // namespace osio
