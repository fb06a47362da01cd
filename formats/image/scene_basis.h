// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/collapse/weights.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Files that hold coefficients of a scene's own curves in place of bands.
namespace osio::image {

namespace attribute {
/// Lines of numbers between ';': the names of the bands, then for each coefficient its share of each band.
inline constexpr const char* kSceneBasis = "spectral:sceneBasis";
}  // namespace attribute

/// "coefficient.007".
[[nodiscard]] std::string coefficient_name(std::size_t index);

/// The attribute's text. `expansion`: bands x coefficients.
[[nodiscard]] std::string scene_basis_text(const std::vector<std::string>& bands,
                                           const WeightMatrix& expansion);

/// A file whose only part has the attribute, with its bands: each the sum of the coefficients in double, rounded once to
/// float. Other channels are as they are; any other file is itself. Damaged for a text that is none or channels that
/// are not there; Unsupported in several parts.
[[nodiscard]] Result<std::shared_ptr<const SpectralImage>>
expand_scene_basis(std::shared_ptr<const SpectralImage> file);

}  // namespace osio::image
