// SPDX-License-Identifier: Apache-2.0
#include <formats/files/checked_file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>
#include <utility>

namespace osio::files {

namespace {

/// Image libraries write numbers of a few bytes; the system is asked for these many at once.
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

}  // namespace

CheckedFile::CheckedFile(const std::string& path)
    : m_descriptor(::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666)) {
    if (m_descriptor < 0)
        note();
}

CheckedFile::~CheckedFile() {
    close();
}

bool CheckedFile::write(const void* bytes, std::size_t count) {
    const char* const from = static_cast<const char*>(bytes);
    if (m_buffer.size() + count > kBufferBytes)
        flush();
    if (count > kBufferBytes)
        store(from, count);
    else if (count != 0)
        m_buffer.insert(m_buffer.end(), from, from + count);
    m_position += count;
    m_size = std::max(m_size, m_position);
    return m_errno == 0;
}

bool CheckedFile::seek(std::uint64_t position) {
    flush();
    if (::lseek(m_descriptor, static_cast<off_t>(position), SEEK_SET) < 0)
        note();
    m_position = position;
    return m_errno == 0;
}

int CheckedFile::close() {
    flush();
    if (m_descriptor >= 0 && ::close(std::exchange(m_descriptor, -1)) != 0)
        note();
    return m_errno;
}

std::string CheckedFile::failure() const {
    return m_errno == 0 ? std::string() : std::strerror(m_errno);
}

void CheckedFile::flush() {
    store(m_buffer.data(), m_buffer.size());
    m_buffer.clear();
}

void CheckedFile::store(const char* bytes, std::size_t count) {
    while (count != 0 && m_errno == 0) {
        const ssize_t done = ::write(m_descriptor, bytes, count);
        if (done < 0 && errno != EINTR)
            note();
        if (done > 0) {
            bytes += done;
            count -= static_cast<std::size_t>(done);
        }
    }
}

void CheckedFile::note() {
    if (m_errno == 0)
        m_errno = errno != 0 ? errno : EIO;
}

}  // namespace osio::files
