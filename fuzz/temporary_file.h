// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fuzz/target.h>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace osio::fuzz {

/// Bytes under a path, in memory.
class TemporaryFile {
  public:
    TemporaryFile(const std::uint8_t* bytes, std::size_t count) : m_descriptor(::memfd_create("fuzz", 0)) {
        require(m_descriptor >= 0 && ::write(m_descriptor, bytes, count) == static_cast<ssize_t>(count));
    }

    ~TemporaryFile() { ::close(m_descriptor); }

    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(m_descriptor); }

  private:
    int m_descriptor;
};

}  // namespace osio::fuzz
