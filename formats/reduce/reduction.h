// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/replacement_file.h>

#include <osio/base/result.h>
#include <osio/collapse/request.h>
#include <osio/collapse/stream.h>
#include <osio/collapse/text_loader.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// The smallest spectral file that a scene requires under some lights and observers.
namespace osio::reduce {

/// What is to be reduced, for whom, and how far it may be off.
struct Request {
    std::string input;
    std::string output;     ///< .exr or .spexr
    CollapseRequest words;  ///< of the input: wavelengths, quantity, part, set, basis, white-luminance
    std::vector<std::string> lights;                ///< names or tables; none for radiance
    std::vector<std::string> observers{"cie1931"};  ///< colorimetric ones
    bool scene_basis = false;  ///< coefficients of the scene's own curves in place of bins
    double tolerance = 0;      ///< CIEDE2000 that no pixel may exceed
    std::string compression;   ///< empty: the one that is read fastest
    int most_passes = 16;      ///< attempts, each over all pixels; NotCertified after as many
    files::Durability durability = files::Durability::Handed;
};

/// What was found under one light and observer.
struct DemandResult {
    std::string light;  ///< empty for radiance
    std::string observer;
    std::string original_plan, reduced_plan;  ///< their ids
    double largest = 0, mean = 0;             ///< CIEDE2000
    std::array<int, 2> largest_at{};          ///< column and row of the data window
    std::uint64_t undefined = 0;              ///< pixels without colour in the original: NaN or infinite
};

/// The same under a light, or of radiance for an observer, that was not asked for: of sampled pixels, so that no
/// more than the exclusion is proved.
struct OtherResult {
    std::string light, observer;
    double largest = 0;
};

/// What a reduction is, what was proved of it, and what was lost.
struct Reduction {
    std::string source;              ///< the input's name without its folder
    std::uint64_t source_bytes = 0;  ///< its size
    std::size_t source_bands = 0;
    std::string source_samples;  ///< half, float, uint
    std::string set;
    double tolerance = 0;
    double white_luminance = 1;
    std::string white_reason;

    std::vector<double> wavelengths_nm;  ///< of the bands that are stored
    std::vector<double> edges_nm;        ///< of their bins; none where all bands stay
    std::size_t coefficients = 0;        ///< planes that are stored in place of bands; 0: bands
    std::string basis;                   ///< what `spectral:basis` says
    std::string samples;                 ///< half, float
    std::string compression;             ///< none, zip, ...
    double fidelity = 0;                 ///< of BinFit

    std::uint64_t pixels = 0;
    std::vector<DemandResult> demands;
    std::uint64_t changed_pixels = 0;  ///< would be below zero where no sample of the original's pixel is
    std::uint64_t negative_samples =
        0;                              ///< stored, where some sample of the original's pixel is negative too
    std::uint64_t clamped_samples = 0;  ///< beyond +-65504 in a half

    std::uint64_t sampled_pixels = 0;
    double spectrum_rms = 0, spectrum_largest = 0;  ///< stored curve against the bands, of the sampled pixels
    std::vector<OtherResult> others;                ///< of the sampled pixels
    std::vector<std::string> lost;                  ///< channels, parts and attributes, in words

    /// Lights or observers for which a sampled pixel exceeds the tolerance: names as in `others`.
    [[nodiscard]] std::vector<std::string> not_for() const;
};

/// A reduction and the file that holds it.
struct Outcome {
    Reduction reduction;
    std::string output;
    std::uint64_t bytes = 0;  ///< of the file
    int width = 0, height = 0;
    int passes = 0;  ///< over all pixels
    std::vector<std::string> warnings;
};

/// Writes the output, which takes its place only when every pixel was verified as it is stored, and gives it the
/// attribute `spectral:reduction`.
///
/// Fewest bands that hold on sampled pixels are written and verified in one pass over the image; pixels that exceed
/// the tolerance join the sample, until all hold. Memory is a few blocks a worker.
///
/// Usage for a tolerance that is not above 0, lights for radiance, an output that is the input or of
/// another format; MissingIlluminant for reflectance without lights; Unsupported for fluorescence, Stokes components and lossy
/// compression; NotCertified where no fewer bytes a pixel than the original's hold; and the refusals of
/// open_collapse() and of writing.
[[nodiscard]] Result<Outcome> reduce(const Request& request, const TextLoader& load_text, Runner& runner,
                                     const Progress& progress);

/// Everything as JSON: indented, or in one line for an attribute.
[[nodiscard]] std::string reduction_json(const Reduction& reduction, bool one_line);

/// The same, indented, with what is known of the file.
[[nodiscard]] std::string outcome_json(const Outcome& outcome, double seconds);

/// Bytes that reduction_json() in one line does not exceed, whatever the pixels.
[[nodiscard]] std::size_t most_reduction_bytes(const Reduction& reduction);

}  // namespace osio::reduce
