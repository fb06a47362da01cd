// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace osio::files {

/// A file's bytes, read at any place by any number of threads.
class RawFile {
  public:
    [[nodiscard]] static Result<RawFile> open(const std::string& path);

    RawFile(RawFile&& other) noexcept;
    RawFile& operator=(RawFile&&) = delete;
    RawFile(const RawFile&) = delete;
    RawFile& operator=(const RawFile&) = delete;
    ~RawFile();

    /// Bytes when it was opened.
    [[nodiscard]] std::uint64_t size() const { return m_size; }

    /// `count` bytes from `at` on into `out`, which is resized. Damaged where the file ends before.
    [[nodiscard]] Result<void> read(std::uint64_t at, std::uint64_t count, std::string& out) const;

    /// The same into memory of the caller's.
    [[nodiscard]] Result<void> read(std::uint64_t at, std::uint64_t count, std::byte* out) const;

  private:
    /// Damaged where the bytes lie beyond the end.
    [[nodiscard]] Result<void> check(std::uint64_t at, std::uint64_t count) const;

    RawFile(int descriptor, std::uint64_t size) : m_descriptor(descriptor), m_size(size) {}

    int m_descriptor;
    std::uint64_t m_size;
};

/// Writes bytes over those at a place of a file that exists. Io where the system refuses.
[[nodiscard]] Result<void> overwrite(const std::string& path, std::uint64_t at, std::string_view bytes);

}  // namespace osio::files
