// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/convert/sink.h>

namespace osio::convert {

/// True where an image of several parts goes into an EXR and no word chooses among them or changes bands.
[[nodiscard]] bool takes_all_parts(const Request& request, const Target& target,
                                   const image::SpectralImage& image);

/// Writes every part of the image, each in a pass of its own, with or without bands. Parts that have no planes of
/// samples, deep or sub-sampled, are named as lost.
[[nodiscard]] Result<void> write_all_parts(const Request& request,
                                           const std::shared_ptr<const image::SpectralImage>& image,
                                           Runner& runner, const Progress& progress, Outcome& outcome);

}  // namespace osio::convert
