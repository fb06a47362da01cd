// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_header.h>

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>
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

/// What is to be converted, and how. What is empty is decided by the input or the output's format.
struct Request {
    std::string input;
    std::string output;                          ///< its ending says the format: .exr, .spexr, .hdr
    OpenWords words;                             ///< what the user says of the input
    std::string part;                            ///< number from 0, or name
    std::string set;                             ///< "T", "left.S0", ...
    std::optional<Range> bands;                  ///< bands outside are left out
    std::optional<SampleType> depth;             ///< of .exr: half or float; else each channel keeps its type
    std::optional<envi::Interleave> interleave;  ///< of .hdr; else bsq
    std::string compression;                     ///< of .exr; else zip
};

/// What became of it.
struct Outcome {
    std::string output;
    std::string data;  ///< of ENVI: the data file
    int width = 0, height = 0;
    std::size_t bands = 0;
    std::vector<std::string> types;     ///< of the samples written, each once
    std::vector<std::string> lost;      ///< what the output does not hold, in words
    std::vector<std::string> warnings;  ///< of the input
    std::uint64_t clamped_samples = 0;  ///< beyond +-65504 in a half
};

/// Reads the input block by block and writes the output, which takes its place when it is complete; where
/// anything fails what was there stays. Usage for an ending that is no format of ours or words that do not fit it,
/// the refusals of open_image() and select_set(), Unsupported where no band is in range.
[[nodiscard]] Result<Outcome> convert(const Request& request, Runner& runner, const Progress& progress);

}  // namespace osio::convert
