// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/layout/open_words.h>

#include <memory>
#include <string>

namespace osio::image {

/// Opens a file of any format that we read, with what the user says of it. Its first bytes decide which, not its
/// name. Io where the system refuses, NotSpectral where it is of no such format, Contradiction where the words fit
/// no part of it, Damaged and the format's other refusals.
[[nodiscard]] Result<std::shared_ptr<const SpectralImage>> open_image(const std::string& path,
                                                                      const OpenWords& words = {});

/// True where the file exists and starts like one that open_image() reads. Cheap; never an error.
[[nodiscard]] bool is_ours(const std::string& path);

}  // namespace osio::image
