// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/collapse_job.h>
#include <formats/exr/exr_file.h>

#include <osio/collapse/collapse_stream.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What osiotool tells, as text for people and as JSON for programs. The JSON is documented in
/// docs/cli.md and stable: keys are added, never renamed.
namespace osio::tool {

/// What became of a collapse.
struct CollapseOutcome {
    std::string output;
    std::string type;  ///< half, float, uint8, uint16
    CollapseCounts counts;
    std::uint64_t clamped_samples = 0;  ///< beyond +-65504 in a half
    std::uint64_t clipped_pixels = 0;   ///< outside 0 to 1 in an integer
    double seconds = 0;
};

[[nodiscard]] std::string info_text(const exr::ExrFile& file);
[[nodiscard]] std::string info_json(const exr::ExrFile& file);

[[nodiscard]] std::string plan_text(const exr::CollapseJob& job);
[[nodiscard]] std::string plan_json(const exr::CollapseJob& job);

[[nodiscard]] std::string outcome_text(const exr::CollapseJob& job, const CollapseOutcome& outcome);
[[nodiscard]] std::string outcome_json(const exr::CollapseJob& job, const CollapseOutcome& outcome);

/// "400-700 nm, every 10 nm", "400-700 nm, spacing 5-20 nm", "550 nm".
[[nodiscard]] std::string spacing_text(const std::vector<double>& wavelengths_nm);

}  // namespace osio::tool
