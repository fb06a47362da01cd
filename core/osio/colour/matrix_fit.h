// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>

#include <span>
#include <utility>

namespace osio {

/// The 3x3 matrix M that minimises the sum of |M from[i] - to[i]|^2, by the normal equations. InvalidGrid
/// where `from` spans less than three dimensions: fewer than three colours, or all in one plane.
[[nodiscard]] Result<Matrix3> fit_matrix(std::span<const Vector3> from, std::span<const Vector3> to);

/// The same among the matrices that take the first of `kept` exactly to the second.
[[nodiscard]] Result<Matrix3> fit_matrix_keeping(const std::pair<Vector3, Vector3>& kept,
                                                 std::span<const Vector3> from, std::span<const Vector3> to);

}  // namespace osio
