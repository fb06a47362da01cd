// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

namespace osio {

/// Recognises the spectral channel names of other programs, so that a refusal can say whose file it
/// is. Returns the dialect in words ("Mitsuba 0.x wavelength bins such as \"395.00-405.00nm\""), or
/// nothing. At least two channels must fit. `attribute_names` are those of the part's header.
[[nodiscard]] std::optional<std::string> recognise_dialect(std::span<const std::string> channel_names,
                                                           std::span<const std::string> attribute_names);

}  // namespace osio
