// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace osio {

/// Three doubles: a tristimulus value, a row of a matrix.
using Vector3 = std::array<double, 3>;

/// A 3x3 matrix by rows. Names read target_from_source, so products read right to left.
struct Matrix3 {
    std::array<Vector3, 3> rows{};

    [[nodiscard]] static constexpr Matrix3 identity() { return diagonal({1, 1, 1}); }

    [[nodiscard]] static constexpr Matrix3 diagonal(const Vector3& d) {
        return {{{{d[0], 0, 0}, {0, d[1], 0}, {0, 0, d[2]}}}};
    }

    friend constexpr bool operator==(const Matrix3&, const Matrix3&) = default;
};

[[nodiscard]] constexpr Vector3 operator*(const Matrix3& m, const Vector3& v) {
    Vector3 out{};
    for (std::size_t r = 0; r < 3; ++r)
        out[r] = m.rows[r][0] * v[0] + m.rows[r][1] * v[1] + m.rows[r][2] * v[2];
    return out;
}

[[nodiscard]] constexpr Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
    Matrix3 out;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            out.rows[r][c] =
                a.rows[r][0] * b.rows[0][c] + a.rows[r][1] * b.rows[1][c] + a.rows[r][2] * b.rows[2][c];
    return out;
}

/// The inverse by cofactors. The matrices here (primaries, cone responses) have condition numbers
/// below 10, so cofactors lose no more than a few units in the last place; a singular matrix gives
/// infinities.
[[nodiscard]] constexpr Matrix3 inverse(const Matrix3& m) {
    const auto& a = m.rows;
    Matrix3 cofactor_transpose;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t r1 = (c + 1) % 3, r2 = (c + 2) % 3;
            const std::size_t c1 = (r + 1) % 3, c2 = (r + 2) % 3;
            cofactor_transpose.rows[r][c] = a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1];
        }
    const double determinant = a[0][0] * cofactor_transpose.rows[0][0] +
                               a[0][1] * cofactor_transpose.rows[1][0] +
                               a[0][2] * cofactor_transpose.rows[2][0];
    for (Vector3& row : cofactor_transpose.rows)
        for (double& x : row)
            x /= determinant;
    return cofactor_transpose;
}

}  // namespace osio
