// SPDX-License-Identifier: Apache-2.0
#include <plugins/common/open_options.h>

#include <formats/files/config_module.h>
#include <formats/files/text_file.h>
#include <formats/image/open_image.h>

#include <osio/base/text.h>
#include <osio/collapse/output_resolver.h>

#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

namespace osio::plugin {

namespace {

constexpr std::string_view kHintPrefix = "spectral:";
constexpr std::string_view kSource = "source";

bool has_extension(std::string_view name, std::string_view extension) {
    return to_lower(name).ends_with(extension);
}

bool exists(const std::string& path) {
    return std::ifstream(path).good();
}

/// A name cut at its first '?'.
struct QueryName {
    std::string base;
    std::string_view query;
};

QueryName cut_query(const std::string& name) {
    const auto mark = name.find('?');
    return {name.substr(0, mark), std::string_view(name).substr(mark + 1)};
}

Result<void> apply_query(std::string_view query, CollapseRequest& request) {
    for (const std::string_view option : split(query, '&')) {
        const auto equals = option.find('=');
        if (equals == std::string_view::npos)
            return fail(ErrorCode::Usage,
                        "found \"" + std::string(option) + "\" in the query, expected key=value");
        OSIO_CHECK_OK(set_option(request, option.substr(0, equals), option.substr(equals + 1)));
    }
    return {};
}

/// A '#' starts a comment at the start of a line or after white space; inside a word it is a letter.
std::string_view without_comment(std::string_view line) {
    for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t'))
            return line.substr(0, i);
    return line;
}

/// A value whose tables are meant relative to the recipe's folder.
std::string tables_seen_from(const std::string& folder, std::string_view key, const std::string& value) {
    if (key == "config" && value.find("://") == std::string::npos)
        return files::seen_from(folder, value);
    std::vector<std::string> out;
    for (const std::string_view piece : split(value, takes_tables(key) ? ',' : '\0')) {
        const std::string name(trim(piece));
        out.push_back(takes_tables(key) && is_table_path(name) ? files::seen_from(folder, name) : name);
    }
    return join(out, ",");
}

/// Hints arrive as text, int or float, by how they look; they are read by value, not by type.
Result<void> apply_hints(const OIIO::ImageSpec& config, CollapseRequest& request) {
    for (const OIIO::ParamValue& hint : config.extra_attribs) {
        const std::string name = hint.name().string();
        if (name.starts_with(kHintPrefix))
            OSIO_CHECK_OK(set_option(request, name.substr(kHintPrefix.size()), hint.get_string()));
    }
    return {};
}

/// The module lies beside the folders of plugins, wherever the installation was moved to.
ConfigLoader colour_configs() {
    Dl_info own{};
    ::dladdr(reinterpret_cast<const void*>(&colour_configs), &own);
    std::error_code error;
    const auto plugin = std::filesystem::canonical(own.dli_fname, error);
    return files::config_loader((plugin.parent_path().parent_path() / OSIO_OCIO_MODULE).string());
}

}  // namespace

NameKind kind_of(const std::string& name) {
    if (name.find('?') != std::string::npos && !exists(name))
        return NameKind::Query;
    if (has_extension(name, ".spectral"))
        return NameKind::Recipe;
    return has_extension(name, ".spexr") ? NameKind::Own : NameKind::Other;
}

Result<OpenRequest> read_recipe(const std::string& path) {
    OSIO_TRY(const std::string text, files::read_text(path));
    const std::string folder = files::folder_of(path);
    OpenRequest out;
    int number = 0;
    for (const std::string_view raw : split(text, '\n')) {
        ++number;
        const std::string_view line = trim(without_comment(raw));
        if (line.empty())
            continue;
        const std::string where = path + ": line " + std::to_string(number);
        const auto equals = line.find('=');
        if (equals == std::string_view::npos)
            return fail(ErrorCode::Usage,
                        "found \"" + std::string(line.substr(0, 60)) + "\", expected key = value", where);
        const std::string_view key = trim(line.substr(0, equals));
        std::string value(trim(line.substr(equals + 1)));
        if (key == kSource) {
            out.path = files::seen_from(folder, value);
            continue;
        }
        value = tables_seen_from(folder, key, value);
        if (auto result = set_option(out.request, key, value); !result)
            return fail_in(where, std::move(result).error());
    }
    if (out.path.empty())
        return fail(ErrorCode::Usage, "a recipe needs a line source = FILE.exr", path);
    return out;
}

Result<OpenRequest> resolve_open(const std::string& name, const OIIO::ImageSpec* config) {
    QueryName cut{name, {}};
    const bool query = kind_of(name) == NameKind::Query;
    if (query)
        cut = cut_query(name);
    OpenRequest out{cut.base, {}};
    if (has_extension(cut.base, ".spectral")) {
        OSIO_TRY(out, read_recipe(cut.base));
    }
    if (config != nullptr)
        OSIO_CHECK_OK(apply_hints(*config, out.request));
    if (query)
        OSIO_CHECK_OK(apply_query(cut.query, out.request));
    OSIO_CHECK_OK(resolve_output(out.request, colour_configs()));
    return out;
}

bool names_our_file(const std::string& name) {
    const NameKind kind = kind_of(name);
    if (kind == NameKind::Other)
        return false;
    const std::string base = kind == NameKind::Query ? cut_query(name).base : name;
    if (!has_extension(base, ".spectral"))
        return image::is_ours(base);
    const auto recipe = read_recipe(base);
    return recipe && image::is_ours(recipe->path);
}

bool has_spectral_hint(const OIIO::ImageSpec& config) {
    for (const OIIO::ParamValue& hint : config.extra_attribs)
        if (hint.name().string().starts_with(kHintPrefix))
            return true;
    return false;
}

}  // namespace osio::plugin
