// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/reduce/reduction.h>

#include <string>

namespace osio::tool {

/// What a reduction is, what was proved and what was lost, for people.
[[nodiscard]] std::string reduce_text(const reduce::Outcome& outcome, double seconds);

}  // namespace osio::tool
