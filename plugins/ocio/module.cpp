// SPDX-License-Identifier: Apache-2.0
//
// The shared object through which osiotool and plugins reach OpenColorIO, opened only when a name asks
// for it.
#include <plugins/ocio/config.h>

#include <formats/files/config_module.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <system_error>

namespace osio::ocio {

namespace {

using Config = std::shared_ptr<const ColourConfig>;

/// The config of the last call, kept while its file stays as it was: frames of a sequence share it.
class LastConfig {
  public:
    Result<Config> open(const std::string& path) {
        const std::lock_guard lock(m_mutex);
        std::error_code error;
        const auto changed = std::filesystem::last_write_time(path, error);
        // Configs that are part of OpenColorIO ("ocio://...", since its version 2.2) are no files.
        if (error && path.find("://") == std::string::npos)
            return fail(ErrorCode::Io, "no colour config can be read: " + error.message(), path);
        if (m_config && m_path == path && m_changed == changed)
            return m_config;
        try {
            m_config = std::make_shared<OcioConfig>(path, OCIO::Config::CreateFromFile(path.c_str()));
        } catch (const std::exception& reason) {
            m_config.reset();
            return fail(ErrorCode::Usage, std::string("is no colour config: ") + reason.what(), path);
        }
        m_path = path;
        m_changed = changed;
        return m_config;
    }

  private:
    std::mutex m_mutex;
    std::string m_path;
    std::filesystem::file_time_type m_changed;
    Config m_config;
};

Result<Config> open_config(const std::string& path) {
    static LastConfig last;
    if (!path.empty())
        return last.open(path);
    const char* const named = std::getenv(OCIO::OCIO_CONFIG_ENVVAR);
    return named == nullptr || *named == '\0' ? Config() : last.open(named);
}

}  // namespace

}  // namespace osio::ocio

extern "C" __attribute__((visibility("default"))) const osio::ConfigLoader* osio_ocio_module();

const osio::ConfigLoader* osio_ocio_module() {
    static const osio::ConfigLoader loader = osio::ocio::open_config;
    return &loader;
}
