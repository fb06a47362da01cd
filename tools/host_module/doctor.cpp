// SPDX-License-Identifier: Apache-2.0
//
// OpenImageIO ignores a plugin that it cannot load, without a word. This follows its search by hand
// and says at which step it ends.
#include <tools/host_module/doctor.h>

#include <osio/base/text.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>

namespace osio::host {

namespace {

constexpr const char* kFormat = "spectralexr";
constexpr const char* kFileName = "spectralexr.imageio.so";
constexpr const char* kEnviFormat = "envi";
constexpr const char* kEnviFileName = "envi.imageio.so";
constexpr const char* kVersionSymbol = "spectralexr_imageio_version";
constexpr const char* kLibrarySymbol = "spectralexr_imageio_library_version";

std::string host_attribute(const char* name) {
    return std::string(OIIO::get_string_attribute(name));
}

std::string environment(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string() : value;
}

/// Where OpenImageIO 2.4 looks, in its order.
std::vector<std::string> search_path() {
    std::vector<std::string> folders;
    for (const std::string& list : {environment("OIIO_LIBRARY_PATH"), host_attribute("plugin_searchpath"),
                                    environment("LD_LIBRARY_PATH")})
        for (const auto folder : split(list, ':'))
            if (!folder.empty())
                folders.emplace_back(folder);
    return folders;
}

bool in_list(const std::string& list, std::string_view name) {
    const auto names = split(list, ',');
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Why a plugin file cannot be loaded; empty where it can.
std::string why_not_loaded(const std::string& path) {
    void* const handle = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr)
        return std::string("the system cannot load it: ") + ::dlerror();
    const auto* const version = static_cast<const int*>(::dlsym(handle, kVersionSymbol));
    if (version == nullptr)
        return std::string("it has no symbol ") + kVersionSymbol;
    if (*version != OIIO_PLUGIN_VERSION)
        return "it was built for plugin version " + std::to_string(*version) +
               " of OpenImageIO, this one has " + std::to_string(OIIO_PLUGIN_VERSION);
    return {};
}

std::string library_version(const std::string& path) {
    void* const handle = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr)
        return {};
    using Function = const char* (*)();
    const auto function = reinterpret_cast<Function>(::dlsym(handle, kLibrarySymbol));
    return function == nullptr ? std::string() : function();
}

class Examination {
  public:
    explicit Examination(const std::string& plugin_folder) : m_folder(plugin_folder) {}

    std::vector<Finding> run() {
        add(Kind::Good, "OpenImageIO " + host_attribute("version"));
        // The first request for a format makes OpenImageIO catalogue every plugin it finds.
        const auto input = OIIO::ImageInput::create(kFormat);
        OIIO::geterror();
        const std::string used = follow_the_search();
        if (input && in_list(host_attribute("format_list"), kFormat))
            add(Kind::Good, "OpenImageIO sees the plugin " + used + " (" + library_version(used) + ")");
        else
            explain();
        if (!in_list(host_attribute("format_list"), kEnviFormat))
            add(Kind::Note, std::string("OpenImageIO does not see ") + kEnviFileName +
                                ": ENVI cubes are read by a query (cube.hdr?to=raw) only");
        if (OIIO::get_int_attribute("try_all_readers", 1) == 0)
            add(Kind::Problem, "try_all_readers is 0: names with a query (shot.exr?to=...) will not be "
                               "read; .spectral and .spexr will");
        return std::move(m_findings);
    }

  private:
    using Kind = Finding::Kind;

    void add(Kind kind, std::string text) { m_findings.push_back({kind, std::move(text)}); }

    /// The first plugin file on the way that can be loaded; empty where there is none. Those before
    /// it are passed over, as OpenImageIO does without a word.
    std::string follow_the_search() {
        for (const std::string& folder : search_path()) {
            const std::string file = folder + "/" + kFileName;
            if (!std::filesystem::exists(file))
                continue;
            const std::string why = why_not_loaded(file);
            if (why.empty())
                return file;
            add(Kind::Note, file + " is passed over: " + why);
        }
        return {};
    }

    void explain() {
        add(Kind::Problem, "OpenImageIO does not see the plugin");
        const std::vector<std::string> folders = search_path();
        if (folders.empty())
            add(Kind::Problem, "it looks nowhere: OIIO_LIBRARY_PATH is not set, and this OpenImageIO "
                               "has no folder of its own");
        else
            add(Kind::Problem,
                std::string("no ") + kFileName + " that it can load in " + join(folders, ", "));
        const std::string own = m_folder + "/" + kFileName;
        if (!std::filesystem::exists(own))
            add(Kind::Problem, "this installation has no " + own);
        else if (const std::string why = why_not_loaded(own); !why.empty())
            add(Kind::Problem, own + ": " + why);
        else
            add(Kind::Problem, "to use it: export OIIO_LIBRARY_PATH=" + m_folder);
    }

    const std::string& m_folder;
    std::vector<Finding> m_findings;
};

}  // namespace

std::vector<Finding> examine_host(const std::string& plugin_folder) {
    return Examination(plugin_folder).run();
}

}  // namespace osio::host
