// SPDX-License-Identifier: Apache-2.0
#include <formats/files/temporary_folder.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace osio::files {

Result<TemporaryFolder> TemporaryFolder::create(std::string_view purpose) {
    std::error_code error;
    // mkdtemp() takes six X for the letters that make the name its own.
    const std::string name = "osio-" + std::string(purpose) + "-XXXXXX";
    std::string folder = (std::filesystem::temp_directory_path(error) / name).string();
    if (error || ::mkdtemp(folder.data()) == nullptr)
        return fail(ErrorCode::Io, error ? error.message() : std::strerror(errno), folder);
    return TemporaryFolder(std::move(folder));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code error;
    if (!m_path.empty())
        std::filesystem::remove_all(m_path, error);
}

}  // namespace osio::files
