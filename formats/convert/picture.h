// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/choice.h>

namespace osio::convert {

/// The choice with R, G, B made of its set's bands by preview_plan(), instead of those that it had; behind the set's
/// root where it has one. `light` is a light's name or table, or "none" for radiance. The refusals of make_plan().
[[nodiscard]] Result<Choice> with_picture(Choice choice, const std::string& light);

}  // namespace osio::convert
