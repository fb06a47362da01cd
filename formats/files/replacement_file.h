// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <string>

namespace osio::files {

/// When a file counts as written.
enum class Durability {
    Handed,  ///< the system has every byte; it stores them within seconds
    Stored,  ///< the storage has every byte, and the name: it outlives a loss of power
};

/// A new file that takes an old one's place only when it is complete. It lies beside its target, so
/// that the rename stays within one file system, and is removed unless it was committed.
class ReplacementFile {
  public:
    /// Makes an empty temporary beside `target`. Io where the folder cannot be written.
    [[nodiscard]] static Result<ReplacementFile> create(const std::string& target);

    ReplacementFile(ReplacementFile&& other) noexcept;
    ReplacementFile& operator=(ReplacementFile&&) = delete;
    ReplacementFile(const ReplacementFile&) = delete;
    ReplacementFile& operator=(const ReplacementFile&) = delete;
    ~ReplacementFile();

    [[nodiscard]] const std::string& path() const { return m_path; }

    [[nodiscard]] const std::string& target() const { return m_target; }

    /// Gives the temporary the target's name, and the target's permissions where there was one. With
    /// Stored, bytes are synchronised before the rename and the folder after it; where the latter fails
    /// the new file is in its place, and the error says so.
    [[nodiscard]] Result<void> commit(Durability durability = Durability::Handed);

  private:
    ReplacementFile(std::string path, std::string target)
        : m_path(std::move(path)), m_target(std::move(target)) {}

    std::string m_path;  // empty once committed or moved from
    std::string m_target;
};

}  // namespace osio::files
