// SPDX-License-Identifier: Apache-2.0
#include <tools/osiotool/host_loader.h>

#include <formats/files/config_module.h>

#include <dlfcn.h>
#include <filesystem>
#include <system_error>

namespace osio::tool {

namespace {

/// Installations can be moved as a whole: everything is found from where the program lies.
std::filesystem::path installation() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path();
}

}  // namespace

Result<const host::HostModule*> load_host_module() {
    const std::string path = (installation() / OSIO_HOST_MODULE).string();
    void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
        return fail(ErrorCode::Io, std::string("OpenImageIO cannot be used: ") + ::dlerror());
    const auto entry = reinterpret_cast<host::Entry>(::dlsym(handle, host::kEntry));
    if (entry == nullptr)
        return fail(ErrorCode::Io, "is no module of this program", path);
    return entry();
}

ConfigLoader colour_configs() {
    return files::config_loader((installation() / OSIO_OCIO_MODULE).string());
}

std::string plugin_folder() {
    return (installation() / OSIO_PLUGIN_DIR).string();
}

}  // namespace osio::tool
