// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/exit_code.h>

#include <osio/base/result.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace osio::tool {

/// The files of one run of a command.
struct FrameFiles {
    std::vector<std::string> inputs;
    std::string output;
    std::string label;         ///< of its progress
    std::optional<int> frame;  ///< its number, of a sequence
};

/// What one run came to.
struct FrameOutcome {
    ExitCode code = kDone;
    std::string json;  ///< its report
};

using RunFrame = std::function<Result<FrameOutcome>(const FrameFiles& files)>;

/// Runs a command on its files, or, where `frames` is not empty, once for each frame, with the frame's number in the
/// places that every input and the output must have for it. A frame that fails is told on stderr and the others go on;
/// an interruption ends it. The code is that of the first frame that did not go well. With `json` the report is
/// printed: of frames an object with one entry for each.
[[nodiscard]] Result<ExitCode> run_frames(const std::string& frames, const FrameFiles& files, bool json,
                                          const RunFrame& run);

}  // namespace osio::tool
