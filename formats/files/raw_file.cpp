// SPDX-License-Identifier: Apache-2.0
#include <formats/files/raw_file.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace osio::files {

namespace {

tl::unexpected<Error> not_written() {
    return fail(ErrorCode::Io, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

Result<RawFile> RawFile::open(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);

    struct stat status {};

    if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
        const int code = errno;
        if (descriptor >= 0)
            ::close(descriptor);
        return fail(ErrorCode::Io, std::strerror(code), path);
    }
    return RawFile(descriptor, static_cast<std::uint64_t>(status.st_size));
}

RawFile::RawFile(RawFile&& other) noexcept
    : m_descriptor(std::exchange(other.m_descriptor, -1)), m_size(other.m_size) {}

RawFile::~RawFile() {
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

Result<void> RawFile::check(std::uint64_t at, std::uint64_t count) const {
    if (at > m_size || count > m_size - at)
        return fail(ErrorCode::Damaged, std::to_string(count) + " bytes at " + std::to_string(at) +
                                            " lie beyond the end of the file (" + std::to_string(m_size) +
                                            " bytes)");
    return {};
}

Result<void> RawFile::read(std::uint64_t at, std::uint64_t count, std::string& out) const {
    OSIO_CHECK_OK(check(at, count));
    out.resize(count);
    return read(at, count, reinterpret_cast<std::byte*>(out.data()));
}

Result<void> RawFile::read(std::uint64_t at, std::uint64_t count, std::byte* out) const {
    OSIO_CHECK_OK(check(at, count));
    for (std::uint64_t done = 0; done < count;) {
        const ssize_t got = ::pread(m_descriptor, out + done, count - done, static_cast<off_t>(at + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return fail(ErrorCode::Io, std::strerror(errno));
        if (got == 0)
            return fail(ErrorCode::Damaged, "became shorter while it was read");
        done += static_cast<std::uint64_t>(got);
    }
    return {};
}

Result<void> overwrite(const std::string& path, std::uint64_t at, std::string_view bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0)
        return not_written();
    Result<void> result;
    while (result && !bytes.empty()) {
        const ssize_t count = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (count < 0 && errno != EINTR)
            result = not_written();
        if (count > 0) {
            at += static_cast<std::uint64_t>(count);
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
    }
    if (::close(descriptor) != 0 && result)
        return not_written();
    return result;
}

}  // namespace osio::files
