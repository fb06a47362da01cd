// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace osio::files {

/// A file for writing that remembers its first failure. Image libraries buffer, and swallow what goes
/// wrong when they close; a full disk would pass unnoticed.
class CheckedFile {
  public:
    explicit CheckedFile(const std::string& path);
    CheckedFile(const CheckedFile&) = delete;
    CheckedFile& operator=(const CheckedFile&) = delete;
    ~CheckedFile();

    /// False once anything has failed.
    bool write(const void* bytes, std::size_t count);
    bool seek(std::uint64_t position);

    [[nodiscard]] std::uint64_t position() const { return m_position; }

    /// One past the last byte that was written.
    [[nodiscard]] std::uint64_t size() const { return m_size; }

    /// Hands every byte to the system; the errno of the first failure since the start, or 0.
    int close();

    /// The first failure in words; empty where there was none.
    [[nodiscard]] std::string failure() const;

  private:
    void store(const char* bytes, std::size_t count);
    void flush();
    void note();

    int m_descriptor;
    std::vector<char> m_buffer;  ///< not yet given to the system; they end at m_position
    std::uint64_t m_position = 0;
    std::uint64_t m_size = 0;
    int m_errno = 0;
};

}  // namespace osio::files
