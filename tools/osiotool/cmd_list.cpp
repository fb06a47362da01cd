// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/commands.h>
#include <tools/osiotool/host_loader.h>
#include <tools/osiotool/report.h>
#include <tools/osiotool/text_table.h>

#include <osio/base/text.h>
#include <osio/collapse/request.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/observer.h>
#include <osio/colour/rgb_space.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace osio::tool {

namespace {

TextTable illuminants() {
    TextTable table({{"illuminant"}, {"source"}});
    for (const std::string& name : illuminant_names())
        table.add({name, find_illuminant(name)->source});
    table.add({"D(kelvin)", "CIE daylight by formula, 4000 to 25000 K (CIE 15:2018, 4.1.2)"});
    table.add({"blackbody(kelvin)", "Planck's law, any temperature above 0 K"});
    return table;
}

TextTable observers() {
    TextTable table({{"observer"}, {"source"}});
    for (const std::string& name : observer_names())
        table.add({name, find_observer(name)->source});
    return table;
}

TextTable spaces() {
    TextTable table({{"space"}, {"oiio:ColorSpace"}, {"also called"}});
    for (const OutputSpace& space : output_spaces()) {
        std::string aliases = space.aliases;
        for (auto at = aliases.find('|'); at != std::string::npos; at = aliases.find('|', at))
            aliases.replace(at, 1, ", ");
        table.add({space.id, space.color_space.empty() ? "none" : space.color_space, aliases});
    }
    return table;
}

/// The names of a colour config.
TextTable spaces_of(const ColourConfig& config) {
    TextTable table({{"name"}, {"kind"}, {"also called"}});
    for (const ConfigName& entry : config.names())
        table.add({entry.name, entry.kind, join(entry.aliases, ", ")});
    return table;
}

/// Our spaces, then those of the config that is active.
Result<void> print_spaces(const ListOptions& options) {
    if (!options.json)
        fmt::print("{}", spaces().text());
    OSIO_TRY(const auto config, colour_configs()(options.config));
    if (options.json) {
        fmt::print("{}", spaces_json(config.get()));
        return {};
    }
    if (config)
        fmt::print("\nof the config {} ({}):\n{}", config->name().empty() ? "of no name" : config->name(),
                   config->file(), spaces_of(*config).text());
    return {};
}

TextTable bases() {
    TextTable table({{"basis"}, {"meaning"}});
    for (const BasisInfo& info : osio::bases())
        table.add({std::string(info.name), std::string(info.meaning)});
    return table;
}

struct List {
    std::string_view name;
    TextTable (*make)();
};

/// Those that are one table.
constexpr std::array<List, 3> kLists{
    {{"illuminants", illuminants}, {"observers", observers}, {"bases", bases}}};

}  // namespace

Result<ExitCode> run_list(const ListOptions& options) {
    if (options.what == "spaces") {
        OSIO_CHECK_OK(print_spaces(options));
        return kDone;
    }
    if (options.json || !options.config.empty())
        return fail(ErrorCode::Usage, "--json and --config are for osiotool list spaces");
    std::vector<std::string> names{"spaces"};
    for (const List& list : kLists) {
        names.emplace_back(list.name);
        if (list.name != options.what)
            continue;
        fmt::print("{}", list.make().text());
        return kDone;
    }
    return fail(ErrorCode::UnknownName,
                "there is no list of \"" + options.what + "\"" + suggestion(options.what, names));
}

}  // namespace osio::tool
