// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/cie_lab.h>
#include <osio/colour/difference.h>
#include <osio/colour/matrix_fit.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// Colours whose third dimension is smaller than this share of their size are a plane: what noise of
/// tables with three digits would make of it is not worth a matrix.
constexpr double kSmallestDepth = 1e-4;

double determinant(const Matrix3& m) {
    const auto& a = m.rows;
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

}  // namespace

Result<Matrix3> fit_matrix(std::span<const Vector3> from, std::span<const Vector3> to) {
    Matrix3 to_from, from_from;  // sums of t s^T and s s^T
    for (std::size_t i = 0; i < from.size(); ++i)
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) {
                to_from.rows[r][c] += to[i][r] * from[i][c];
                from_from.rows[r][c] += from[i][r] * from[i][c];
            }
    const double mean = (from_from.rows[0][0] + from_from.rows[1][1] + from_from.rows[2][2]) / 3;
    if (!(determinant(from_from) > std::pow(kSmallestDepth, 2) * std::pow(mean, 3)))
        return fail(
            ErrorCode::InvalidGrid,
            std::to_string(from.size()) +
                " spectra do not span the three dimensions of colour, so no matrix can be fitted; give "
                "more that differ");
    return to_from * inverse(from_from);
}

FitResidual residual_of(std::span<const Vector3> fitted, std::span<const Vector3> wanted,
                        const Vector3& white) {
    FitResidual out;
    for (std::size_t i = 0; i < fitted.size(); ++i) {
        const double delta = delta_e_2000(lab_of(fitted[i], white), lab_of(wanted[i], white));
        out.mean += delta / static_cast<double>(fitted.size());
        out.max = std::max(out.max, delta);
    }
    return out;
}

}  // namespace osio
