// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/convert.h>
#include <formats/exr/chunk_map.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/soundness.h>
#include <formats/image/certificate.h>
#include <formats/image/collapse_job.h>
#include <formats/image/colour_image.h>

#include <osio/base/value_statistics.h>
#include <osio/collapse/baked_matrix.h>
#include <osio/collapse/collapse_stream.h>
#include <osio/collapse/output_resolver.h>
#include <osio/colour/cct.h>
#include <osio/colour/photometry.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What osiotool tells, as text for people and as JSON for programs. The JSON is documented in
/// docs/cli.md and stable: keys are added, never renamed.
namespace osio::tool {

struct Explained;

/// What became of a collapse.
struct CollapseOutcome {
    std::string output;
    std::string type;  ///< half, float, uint8, uint16
    CollapseCounts counts;
    std::uint64_t clamped_samples = 0;  ///< beyond +-65504 in a half
    std::uint64_t clipped_pixels = 0;   ///< outside 0 to 1 in an integer
    std::vector<exr::BadRows> missing;  ///< damaged rows of the input, written black
    double seconds = 0;
    std::optional<image::Certificate> certificate;  ///< where one was asked for
};

/// What a conversion did.
struct ConvertReport {
    std::string input;
    convert::Outcome outcome;
    double seconds = 0;
};

[[nodiscard]] std::string convert_text(const ConvertReport& report);
[[nodiscard]] std::string convert_json(const ConvertReport& report);

/// What one frame of a sequence came to.
struct FrameReport {
    int frame = 0;
    int code = 0;       ///< the exit code that it alone would have had
    std::string error;  ///< why it failed; empty where it did not
    std::string json;   ///< its command's report; empty where it failed
};

[[nodiscard]] std::string frames_json(const std::vector<FrameReport>& reports);

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

/// What a comparison found.
struct DifferenceOutcome {
    const image::ColourImage& a;
    const image::ColourImage& b;
    DifferenceCounts counts;
    std::string verdict;  ///< PASS, WARNING, FAILURE; empty where nothing was to be judged
};

[[nodiscard]] std::string difference_text(const DifferenceOutcome& outcome);
[[nodiscard]] std::string difference_json(const DifferenceOutcome& outcome);

/// What a photometry of an image found; luminances in cd/m2.
struct PhotometryOutcome {
    std::string input;
    std::string set;
    ValueStatistics luminance;
    double scotopic_mean = 0;
    double radiance_mean = 0;  ///< W/(sr m2) over 360-830 nm
    std::vector<std::string> warnings;
};

[[nodiscard]] std::string photometry_text(const PhotometryOutcome& outcome);
[[nodiscard]] std::string photometry_json(const PhotometryOutcome& outcome);

/// What is known of a light: efficacies, white, and colour temperature where it has one.
struct LightOutcome {
    Illuminant light;
    LightPhotometry photometry;
    Chromaticity xy;
    std::optional<ColourTemperature> temperature;
};

[[nodiscard]] std::string light_text(const LightOutcome& outcome);
[[nodiscard]] std::string light_json(const LightOutcome& outcome);

/// A baked matrix, what is left of its fit, and its tables.
[[nodiscard]] std::string bake_text(const BakedMatrix& baked);
[[nodiscard]] std::string bake_json(const BakedMatrix& baked, const std::string& output);

/// Our spaces and those of a colour config, which may be null.
[[nodiscard]] std::string spaces_json(const ColourConfig* config);

[[nodiscard]] std::string info_text(const image::SpectralImage& file);
[[nodiscard]] std::string info_json(const image::SpectralImage& file);

[[nodiscard]] std::string plan_text(const image::CollapseJob& job);
/// One plan as an object, several as the array of an object's `plans`. `explained`: none, or that of each plan.
[[nodiscard]] std::string plans_json(const std::vector<image::CollapseJob>& jobs,
                                     const std::vector<Explained>& explained);

[[nodiscard]] std::string outcome_text(const image::CollapseJob& job, const CollapseOutcome& outcome);
/// One outcome as an object, several as the array of an object's `outputs`.
[[nodiscard]] std::string outcomes_json(const std::vector<image::CollapseJob>& jobs,
                                        const std::vector<CollapseOutcome>& outcomes);

[[nodiscard]] std::string verify_text(const FileSoundness& file);
[[nodiscard]] std::string verify_json(const std::vector<FileSoundness>& files);

/// "400-700 nm, every 10 nm", "400-700 nm, spacing 5-20 nm", "550 nm".
[[nodiscard]] std::string spacing_text(const std::vector<double>& wavelengths_nm);

}  // namespace osio::tool
