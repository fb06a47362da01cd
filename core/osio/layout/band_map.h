// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Which wavelengths a user gives to the channels of a file.
namespace osio {

/// A channel and what it is said to hold.
struct MappedChannel {
    std::string channel;
    double wavelength_nm = 0;
    std::optional<double> fwhm_nm;
};

/// Either wavelengths for channels in numeric order, or channels by name.
struct BandMap {
    std::string words;                    ///< as the user spelt it, for messages
    std::vector<double> steps_nm;         ///< strictly increasing; empty: `channels`
    std::vector<MappedChannel> channels;  ///< distinct names, distinct wavelengths
};

/// A channel's place in a map.
struct MappedBand {
    double wavelength_nm = 0;
    std::optional<double> fwhm_nm;
};

/// Reads START:STEP:END, such as `400:10:700` (nm) or `0.4:0.01:0.7um`: a unit of length behind a number is
/// its own, behind the last it is that of all that have none. END is a wavelength of the steps, to a
/// thousandth of one; equal START and END are one band. Wavelengths are rounded to 1e-9 nm, so that decimal
/// steps give decimal wavelengths. Usage where it is no such range.
[[nodiscard]] Result<BandMap> parse_band_steps(std::string_view text);

/// Reads lines `channel,wavelength[,fwhm]` in any order: nm, or a number with a unit of length; comma,
/// semicolon or tab between the columns; a name that holds its line's separator stands in double quotes; lines
/// that start with `#` and one header line are allowed. `words` is what the user calls the table. Usage
/// names the line: a channel or a wavelength that is there twice, what is no wavelength or width, no line at all.
[[nodiscard]] Result<BandMap> parse_band_table(std::string_view csv, std::string words);

/// True for R, G, B, A and Z, behind any layer: channels that no range of wavelengths means.
[[nodiscard]] bool is_colour_or_depth(std::string_view channel_name);

/// The place of each channel, nothing for those that the map leaves out.
///
/// Steps are for the channels whose names are numbers where there are two or more, else for all but
/// is_colour_or_depth(); in numeric order: "2" before "10", "b9_x" before "b10_a". Contradiction, with both
/// numbers, where there are more or fewer; where a table names a channel that is not there.
[[nodiscard]] Result<std::vector<std::optional<MappedBand>>>
map_bands(const BandMap& map, std::span<const std::string> channel_names);

}  // namespace osio
