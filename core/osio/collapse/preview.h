// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>

#include <span>

/// Does a picture stored beside bands still show the bands?
///
/// A file's R, G, B are a preview that some program made of the bands by a recipe that the file does
/// not state: another light, exposure, primaries or sensor. Whatever the recipe, its result is close
/// to a 3x3 matrix applied to the bands' XYZ (the sensors of such previews are close to linear
/// combinations of the colour-matching functions). So the recipe is fitted where bands and picture
/// are known to belong together, and tested where one of them may have been edited. Operations that
/// treat all channels alike (crop, resize, blur, gain) keep the relation; edits of some bands, or of
/// the picture alone, break it.
namespace osio {

/// The bands' XYZ and the picture's RGB at one pixel.
struct PreviewSample {
    Vector3 xyz{};
    Vector3 rgb{};
};

/// RGB of XYZ by least squares. Where the samples do not determine it (one pixel, one colour), the
/// matrix nearest to a multiple of sRGB's is taken (ridge of 1e-6). Samples that are not finite are
/// left out.
[[nodiscard]] Matrix3 fit_preview(std::span<const PreviewSample> samples);

/// How far a picture is from what a matrix makes of the bands.
struct PreviewDistance {
    double rms = 0;            ///< of the difference, as a share of the picture's own RMS
    double outlier_share = 0;  ///< share of pixels that differ by more than kPreviewOutlier
};

/// A pixel this share of the picture's RMS away is an outlier: edited, or saturated.
inline constexpr double kPreviewOutlier = 0.25;

[[nodiscard]] PreviewDistance preview_distance(std::span<const PreviewSample> samples,
                                               const Matrix3& rgb_from_xyz);

/// True where `written` is explained by the matrix that fits `source`, about as well as `source` is:
/// within twice its RMS or 2 %, and at most 0.1 % more outliers. With an empty `source` nothing is
/// known of the recipe, and any 3x3 matrix that explains `written` to 5 % will do.
[[nodiscard]] bool preview_matches(std::span<const PreviewSample> source,
                                   std::span<const PreviewSample> written);

}  // namespace osio
