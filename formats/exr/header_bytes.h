// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/raw_file.h>
#include <formats/exr/raw_header.h>

#include <string>

namespace osio::exr {

/// The headers of a file, read as far as they go and no further. They point into `bytes`.
[[nodiscard]] Result<RawHeaders> read_raw_headers(const files::RawFile& file, std::string& bytes);

}  // namespace osio::exr
