// SPDX-License-Identifier: Apache-2.0
#include <formats/files/config_module.h>

#include <dlfcn.h>

namespace osio::files {

ConfigLoader config_loader(std::string path) {
    return
        [path = std::move(path)](const std::string& config) -> Result<std::shared_ptr<const ColourConfig>> {
            void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
            if (handle == nullptr)
                return fail(ErrorCode::Io, std::string("OpenColorIO cannot be used: ") + ::dlerror());
            const auto entry = reinterpret_cast<ConfigEntry>(::dlsym(handle, kConfigEntry));
            if (entry == nullptr)
                return fail(ErrorCode::Io, "is no module of this program", path);
            return (*entry())(config);
        };
}

}  // namespace osio::files
