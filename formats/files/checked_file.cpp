// SPDX-License-Identifier: Apache-2.0
#include <formats/files/checked_file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/types.h>
#include <utility>

namespace osio::files {

CheckedFile::CheckedFile(const std::string& path) : m_file(std::fopen(path.c_str(), "wb")) {
    if (m_file == nullptr)
        note();
}

CheckedFile::~CheckedFile() {
    close();
}

bool CheckedFile::write(const void* bytes, std::size_t count) {
    if (count == 0)  // `bytes` may then be null, which fwrite does not allow
        return m_errno == 0;
    if (m_file == nullptr || std::fwrite(bytes, 1, count, m_file) != count)
        note();
    m_position += count;
    m_size = std::max(m_size, m_position);
    return m_errno == 0;
}

bool CheckedFile::seek(std::uint64_t position) {
    if (m_file == nullptr || ::fseeko(m_file, static_cast<off_t>(position), SEEK_SET) != 0)
        note();
    m_position = position;
    return m_errno == 0;
}

int CheckedFile::close() {
    if (m_file != nullptr && std::fclose(std::exchange(m_file, nullptr)) != 0)
        note();
    return m_errno;
}

std::string CheckedFile::failure() const {
    return m_errno == 0 ? std::string() : std::strerror(m_errno);
}

void CheckedFile::note() {
    if (m_errno == 0)
        m_errno = errno != 0 ? errno : EIO;
}

}  // namespace osio::files
