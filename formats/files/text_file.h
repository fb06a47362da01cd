// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/replacement_file.h>

#include <osio/base/result.h>
#include <osio/collapse/plan.h>

#include <string>
#include <string_view>

namespace osio::files {

/// The most text that is read from one file: a table of a light at 0.01 nm takes 2 MB.
inline constexpr std::size_t kMostTextBytes = std::size_t{1} << 24;

/// The whole of a text file. Io where the system refuses or the file exceeds kMostTextBytes.
[[nodiscard]] Result<std::string> read_text(const std::string& path);

/// Makes a text file, or puts it in an old one's place when it is complete. Io where the system refuses;
/// the old file is then as it was.
[[nodiscard]] Result<void> write_text(const std::string& path, std::string_view text);

/// The same for a file whose place was made sure of before the text was known.
[[nodiscard]] Result<void> write_text(ReplacementFile file, std::string_view text);

/// `path` as seen from `folder`: absolute paths stay, an empty folder is the current one.
[[nodiscard]] std::string seen_from(const std::string& folder, std::string_view path);

/// A loader for plans that reads files relative to `folder`.
[[nodiscard]] TextLoader text_loader(std::string folder);

/// The folder part of a path, empty where there is none.
[[nodiscard]] std::string folder_of(const std::string& path);

}  // namespace osio::files
