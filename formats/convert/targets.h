// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/choice.h>

namespace osio::convert {

/// Writes a choice as OpenEXR and completes the outcome.
[[nodiscard]] Result<void> write_exr(const Request& request, const Choice& choice, Runner& runner,
                                     const Progress& progress, Outcome& outcome);

/// Writes a choice as ENVI and completes the outcome.
[[nodiscard]] Result<void> write_envi(const Request& request, const Choice& choice, Runner& runner,
                                      const Progress& progress, Outcome& outcome);

}  // namespace osio::convert
