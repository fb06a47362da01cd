// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/chunk_map.h>
#include <formats/exr/collapse_job.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/soundness.h>

#include <osio/collapse/collapse_stream.h>

#include <cstdint>
#include <memory>
#include <optional>
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
    std::vector<exr::BadRows> missing;  ///< damaged rows of the input, written black
    double seconds = 0;
};

/// What is known of a file after all of it was read.
struct FileSoundness {
    std::string path;
    std::shared_ptr<const exr::ExrFile> file;  ///< null where not even the header can be read
    std::vector<exr::PartSoundness> parts;
    std::optional<Error> failure;  ///< what ended the examination before its end

    [[nodiscard]] bool damaged() const;

    /// "own", "foreign", "none"; "unknown" without a header.
    [[nodiscard]] std::string_view checksum() const;
};

[[nodiscard]] std::string info_text(const exr::ExrFile& file);
[[nodiscard]] std::string info_json(const exr::ExrFile& file);

[[nodiscard]] std::string plan_text(const exr::CollapseJob& job);
[[nodiscard]] std::string plan_json(const exr::CollapseJob& job);

[[nodiscard]] std::string outcome_text(const exr::CollapseJob& job, const CollapseOutcome& outcome);
[[nodiscard]] std::string outcome_json(const exr::CollapseJob& job, const CollapseOutcome& outcome);

[[nodiscard]] std::string verify_text(const FileSoundness& file);
[[nodiscard]] std::string verify_json(const std::vector<FileSoundness>& files);

/// "400-700 nm, every 10 nm", "400-700 nm, spacing 5-20 nm", "550 nm".
[[nodiscard]] std::string spacing_text(const std::vector<double>& wavelengths_nm);

}  // namespace osio::tool
