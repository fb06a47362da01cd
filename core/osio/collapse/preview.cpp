// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/preview.h>
#include <osio/colour/rgb_space.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

constexpr double kRidge = 1e-6;
constexpr double kAllowedRms = 0.02;
constexpr double kAllowedRmsUnknownRecipe = 0.05;
constexpr double kAllowedNewOutliers = 0.001;

double dot(const Vector3& a, const Vector3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool finite(const PreviewSample& s) {
    const auto all = [](const Vector3& v) {
        return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
    };
    return all(s.xyz) && all(s.rgb);
}

}  // namespace

Matrix3 fit_preview(std::span<const PreviewSample> samples) {
    const Matrix3 srgb = inverse(xyz_from_rgb(find_output_space("lin_rec709").value()));
    Matrix3 xyz_xyz, rgb_xyz;  // sums of x x^T and r x^T
    double gain_over = 0, gain_under = 0;
    for (const PreviewSample& s : samples) {
        if (!finite(s))
            continue;
        const Vector3 shown = srgb * s.xyz;
        gain_over += dot(s.rgb, shown);
        gain_under += dot(shown, shown);
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) {
                xyz_xyz.rows[r][c] += s.xyz[r] * s.xyz[c];
                rgb_xyz.rows[r][c] += s.rgb[r] * s.xyz[c];
            }
    }
    const double trace = xyz_xyz.rows[0][0] + xyz_xyz.rows[1][1] + xyz_xyz.rows[2][2];
    if (!(trace > 0))
        return srgb;
    // A minimises |r - A x|^2 + k |A - g S|^2:  A (sum x x^T + k I) = sum r x^T + k g S.
    const double k = kRidge * trace / 3;
    const double gain = gain_under > 0 ? gain_over / gain_under : 1;
    for (std::size_t r = 0; r < 3; ++r) {
        xyz_xyz.rows[r][r] += k;
        for (std::size_t c = 0; c < 3; ++c)
            rgb_xyz.rows[r][c] += k * gain * srgb.rows[r][c];
    }
    return rgb_xyz * inverse(xyz_xyz);
}

PreviewDistance preview_distance(std::span<const PreviewSample> samples, const Matrix3& rgb_from_xyz) {
    double difference = 0, picture = 0;
    std::size_t count = 0;
    for (const PreviewSample& s : samples) {
        if (!finite(s))
            continue;
        const Vector3 shown = rgb_from_xyz * s.xyz;
        const Vector3 d{s.rgb[0] - shown[0], s.rgb[1] - shown[1], s.rgb[2] - shown[2]};
        difference += dot(d, d);
        picture += dot(s.rgb, s.rgb);
        ++count;
    }
    if (difference == 0)
        return {};
    if (picture == 0)
        return {1, 1};
    const double limit = kPreviewOutlier * std::sqrt(picture / static_cast<double>(3 * count));
    std::size_t outliers = 0;
    for (const PreviewSample& s : samples) {
        if (!finite(s))
            continue;
        const Vector3 shown = rgb_from_xyz * s.xyz;
        for (std::size_t c = 0; c < 3; ++c)
            if (std::abs(s.rgb[c] - shown[c]) > limit) {
                ++outliers;
                break;
            }
    }
    return {std::sqrt(difference / picture), static_cast<double>(outliers) / static_cast<double>(count)};
}

bool preview_matches(std::span<const PreviewSample> source, std::span<const PreviewSample> written) {
    if (source.empty())
        return preview_distance(written, fit_preview(written)).rms <= kAllowedRmsUnknownRecipe;
    const Matrix3 recipe = fit_preview(source);
    const PreviewDistance before = preview_distance(source, recipe);
    const PreviewDistance after = preview_distance(written, recipe);
    return after.rms <= std::max(2 * before.rms, kAllowedRms) &&
           after.outlier_share <= before.outlier_share + kAllowedNewOutliers;
}

}  // namespace osio
