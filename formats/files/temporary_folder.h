// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <string>
#include <string_view>
#include <utility>

namespace osio::files {

/// A folder of one's own below the system's for temporary files. It goes, with all that is in it, when this does.
class TemporaryFolder {
  public:
    /// `purpose` stands in its name. Io where the system makes none.
    [[nodiscard]] static Result<TemporaryFolder> create(std::string_view purpose);

    TemporaryFolder(TemporaryFolder&& other) noexcept : m_path(std::exchange(other.m_path, {})) {}

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    [[nodiscard]] std::string path(std::string_view name) const { return m_path + "/" + std::string(name); }

  private:
    explicit TemporaryFolder(std::string path) : m_path(std::move(path)) {}

    std::string m_path;
};

}  // namespace osio::files
