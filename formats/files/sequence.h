// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <string>
#include <string_view>
#include <vector>

/// Numbered files, in OpenImageIO's words for frames.
namespace osio::files {

/// Reads pieces between commas: `7`, `1-10`, `1-10x2` (every second), `1-10y2` (those that x2 leaves out), `10-1`
/// (downwards, as `10-1x2`). In the order that is given; a frame that comes twice counts once. Usage where it is no
/// such text or means more than a million frames.
[[nodiscard]] Result<std::vector<int>> parse_frames(std::string_view text);

/// True where a name holds a place for a frame's number: `%d`, `%04d`, `#`, `####`, `@`.
[[nodiscard]] bool has_frame_place(std::string_view pattern);

/// The name with the frame's number in every such place: `%04d` as printf's, a single `#` as four digits
/// (OpenImageIO's meaning), several as so many digits (that of compositors), each `@` a digit. Longer numbers take the
/// digits that they need.
[[nodiscard]] std::string frame_name(std::string_view pattern, int frame);

}  // namespace osio::files
