// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>
#include <formats/stack/stack_text.h>

#include <osio/base/result.h>
#include <osio/layout/open_words.h>

#include <memory>
#include <span>
#include <string>

/// Images whose bands are files of their own: PNG, TIFF and OpenEXR.
namespace osio::stack {

/// Opens a text file that lists a stack; names in it are relative to it. Io where the system refuses, NotSpectral
/// where it is no such text, Usage for a line that is none, and the refusals of open_stack().
[[nodiscard]] Result<std::shared_ptr<const image::SpectralImage>> open_stack_file(const std::string& path,
                                                                                  const OpenWords& words);

/// Opens files of one channel each as one part, a band a file, in the order of the list. A band's wavelength is that of
/// the list, else of the user's map (whose channels are the files' names without folder and ending), else what the
/// file says (its channel, GDAL's metadata, XMP, ImageDescription), else what its name says (`_450nm`).
///
/// Whole numbers count as fractions of their type's largest in PNG files, with a warning, as that format defines, and
/// as themselves in TIFF files, unless `scale` says what to divide them by. NotSpectral where a file has no wavelength;
/// Unsupported where a file has several channels that differ or no one size with the first, naming both; Usage where
/// a scale is given and a file holds floats.
[[nodiscard]] Result<std::shared_ptr<const image::SpectralImage>> open_stack(const StackText& stack,
                                                                             const OpenWords& words);

/// The same for files without a list.
[[nodiscard]] Result<std::shared_ptr<const image::SpectralImage>>
open_stack(std::span<const std::string> files, const OpenWords& words);

/// True where a file exists and its first line is that of a stack.
[[nodiscard]] bool starts_like_stack(const std::string& path);

}  // namespace osio::stack
