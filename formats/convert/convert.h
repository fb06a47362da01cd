// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_header.h>
#include <formats/exr/output_rows.h>
#include <formats/files/replacement_file.h>

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>
#include <osio/collapse/resampling.h>
#include <osio/collapse/stream.h>
#include <osio/layout/open_words.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Spectral images from one format to another.
namespace osio::convert {

/// Wavelengths in nm, both ends inside.
struct Range {
    double first_nm = 0;
    double last_nm = 0;
};

/// "400-700nm", "0.4-0.7um", "400-700" (nm). Usage where it is no such range or its end is not above its start.
[[nodiscard]] Result<Range> parse_range(std::string_view text);

/// What a file of several is.
enum class Split {
    Bands,  ///< one band of the chosen set
    Sets,   ///< one set
};

/// What is to be converted, and how. What is empty is decided by the input or the output's format.
struct Request {
    std::string input;
    std::vector<std::string> joined;       ///< further files whose channels are put beside the input's
    std::string output;                    ///< its ending says the format: .exr, .spexr, .hdr, .tif, .png
    OpenWords words;                       ///< what the user says of the inputs
    std::string part;                      ///< number from 0, or name
    std::string set;                       ///< "T", "left.S0", ...
    std::optional<Range> bands;            ///< bands outside are left out
    std::optional<Resampling> resampling;  ///< bands at other wavelengths, made of those that stay
    std::string preview;                   ///< a light, or "none" for radiance: R, G, B are made of the bands
    std::optional<SampleType> depth;       ///< of .exr: half or float; else each channel keeps its type
    std::optional<envi::Interleave> interleave;  ///< of .hdr; else bsq
    std::string compression;                     ///< of .exr; else zip
    std::optional<exr::TileSize> tile;           ///< of .exr; else scanlines
    bool multi_part = false;     ///< of .exr: the picture in a part of its own, before the bands
    std::optional<Split> split;  ///< several files
    files::Durability durability = files::Durability::Handed;
};

/// What became of it.
struct Outcome {
    std::string output;
    std::string data;                  ///< of ENVI: the data file
    std::vector<std::string> outputs;  ///< all files that are opened by their name: one, but of a split
    int width = 0, height = 0;
    std::size_t bands = 0;
    std::vector<std::string> types;     ///< of the samples written, each once
    std::vector<std::string> lost;      ///< what the output does not hold, in words
    std::vector<std::string> warnings;  ///< of the input, and of what is made of it
    std::uint64_t clamped_samples = 0;  ///< beyond +-65504 in a half
    std::uint64_t clipped_samples = 0;  ///< outside 0 to 1 in an integer, NaN among them
};

/// Reads the input block by block and writes the output, which takes its place when it is complete; where
/// anything fails what was there stays. A split is written in one pass for every 64 files.
///
/// Usage for an ending that is no format of ours or words that do not fit it, the refusals of open_image(),
/// select_set(), join_images(), plan_resampling() and make_plan(), Unsupported where no band is in range.
[[nodiscard]] Result<Outcome> convert(const Request& request, Runner& runner, const Progress& progress);

}  // namespace osio::convert
