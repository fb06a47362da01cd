// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/matrix_fit.h>

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

/// The sums of t s^T and s s^T.
struct Sums {
    Matrix3 to_from, from_from;
};

Result<Sums> sums_of(std::span<const Vector3> from, std::span<const Vector3> to) {
    Sums sums;
    auto& [to_from, from_from] = sums;
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
    return sums;
}

}  // namespace

Result<Matrix3> fit_matrix(std::span<const Vector3> from, std::span<const Vector3> to) {
    OSIO_TRY(const Sums sums, sums_of(from, to));
    return sums.to_from * inverse(sums.from_from);
}

Result<Matrix3> fit_matrix_keeping(const std::pair<Vector3, Vector3>& kept, std::span<const Vector3> from,
                                   std::span<const Vector3> to) {
    OSIO_TRY(const Sums sums, sums_of(from, to));
    // Lagrange: with G = sum s s^T, free M, and s -> t kept, M + (t - M s) (G^-1 s)^T / (s^T G^-1 s).
    const Matrix3 spread = inverse(sums.from_from);
    Matrix3 out = sums.to_from * spread;
    const auto& [s, t] = kept;
    const Vector3 direction = spread * s, reached = out * s;
    const double length = s[0] * direction[0] + s[1] * direction[1] + s[2] * direction[2];
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            out.rows[r][c] += (t[r] - reached[r]) * direction[c] / length;
    return out;
}

}  // namespace osio
