// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/replacement_file.h>

namespace osio::files {

/// Commits two files that belong together. Where the second cannot take its place the first gives its own
/// back: what was there before is there again.
[[nodiscard]] Result<void> commit_pair(ReplacementFile first, ReplacementFile second,
                                       Durability durability = Durability::Handed);

}  // namespace osio::files
