// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osio::stack {

/// A file of a stack and what its line says of it.
struct StackFile {
    std::string path;
    double wavelength_nm = 0;  ///< 0 where the line does not say
    double fwhm_nm = 0;
};

/// A list of files that are bands of one image.
struct StackText {
    std::vector<StackFile> files;  ///< at least one
    std::optional<double> scale;   ///< what whole numbers are divided by
};

/// The first line of a list.
inline constexpr std::string_view kStackMagic = "#spectral-stack";

/// Reads
///
///     #spectral-stack
///     # a comment
///     scale = 65535
///     file_ms_01.png, 400
///     file_ms_02.png, 410 nm, 10 nm
///
/// Behind a file's name its wavelength and full width at half maximum, in nm or with a unit of length; a name that holds a
/// comma stands in double quotes. NotSpectral where the first line is another; Usage, with the line, for what is no
/// line of a list, a file that is there twice, no file, and more files than a part has channels.
[[nodiscard]] Result<StackText> parse_stack(std::string_view text);

}  // namespace osio::stack
