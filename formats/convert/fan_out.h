// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/sink.h>

#include <span>
#include <string>

namespace osio::convert {

/// A file and what it will hold.
struct Output {
    std::string path;
    Choice choice;
};

/// Writes outputs of one part of one image in one pass over it, and completes them one after the other.
[[nodiscard]] Result<void> write_outputs(const Request& request, const Target& target,
                                         std::span<const Output> outputs, Runner& runner,
                                         const Progress& progress, Outcome& outcome);

/// The name of one file of several: `pattern` with `mark` replaced by `name`, or with `otherwise` before its ending.
[[nodiscard]] std::string split_path(const std::string& pattern, std::string_view mark,
                                     const std::string& name, const std::string& otherwise);

}  // namespace osio::convert
