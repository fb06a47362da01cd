// SPDX-License-Identifier: Apache-2.0
#include <formats/files/replacement_file.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <random>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace osio::files {

namespace {

/// Names of 255 bytes are the most that file systems take; the temporary's suffix needs some.
constexpr std::size_t kMostNameBytes = 200;
constexpr int kAttempts = 100;

tl::unexpected<Error> system_failure(const std::string& what, const std::string& target) {
    return fail(ErrorCode::Io, what + ": " + std::strerror(errno), target);
}

/// Replacing anything but an ordinary file would destroy it (a device, a folder); replacing a file
/// that its owner has protected would go round the protection.
Result<void> check_target(const std::string& target) {
    struct stat status {};

    if (::stat(target.c_str(), &status) != 0)
        return {};
    if (S_ISDIR(status.st_mode))
        return fail(ErrorCode::Io, "is a folder, expected the name of a file", target);
    if (!S_ISREG(status.st_mode))
        return fail(ErrorCode::Io, "is not an ordinary file and is left alone", target);
    if (::access(target.c_str(), W_OK) != 0)
        return system_failure("cannot be replaced", target);
    return {};
}

/// fsync(2) of a file or folder by its name.
bool synchronise(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return false;
    const bool done = ::fsync(descriptor) == 0;
    const int code = errno;
    const bool closed = ::close(descriptor) == 0;
    if (!done)
        errno = code;
    return done && closed;
}

}  // namespace

Result<ReplacementFile> ReplacementFile::create(const std::string& target) {
    OSIO_CHECK_OK(check_target(target));
    const auto slash = target.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : target.substr(0, slash + 1);
    const std::string name = slash == std::string::npos ? target : target.substr(slash + 1);
    std::random_device random;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        std::string path =
            folder + "." + name.substr(0, kMostNameBytes) + "." + std::to_string(random()) + ".tmp";
        const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EEXIST)
            continue;
        if (descriptor < 0)
            return system_failure("cannot be written", target);

        struct stat status {};

        if (::stat(target.c_str(), &status) == 0)
            ::fchmod(descriptor, status.st_mode & 07777);
        ReplacementFile file(std::move(path), target);
        if (::close(descriptor) != 0)
            return system_failure("cannot be written", target);
        return file;
    }
    return system_failure("cannot be written", target);
}

ReplacementFile::ReplacementFile(ReplacementFile&& other) noexcept
    : m_path(std::exchange(other.m_path, {})), m_target(std::move(other.m_target)) {}

ReplacementFile::~ReplacementFile() {
    if (!m_path.empty())
        ::unlink(m_path.c_str());
}

Result<void> ReplacementFile::commit(Durability durability) {
    if (durability == Durability::Stored && !synchronise(m_path))
        return system_failure("cannot be stored", m_target);
    if (std::rename(m_path.c_str(), m_target.c_str()) != 0)
        return system_failure("cannot be replaced", m_target);
    m_path.clear();
    const auto slash = m_target.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : m_target.substr(0, slash + 1);
    if (durability == Durability::Stored && !synchronise(folder))
        return system_failure("is complete, but its folder cannot be stored", m_target);
    return {};
}

}  // namespace osio::files
