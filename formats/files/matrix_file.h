// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/baked_matrix.h>

#include <string>

namespace osio::files {

/// Where a .cube holds a matrix: inside, its interpolation is the matrix; outside it clips.
struct CubeDomain {
    double low = 0;
    double high = 1;
    int size = 2;  ///< points along each edge, 2 to 129; two say all that a matrix can
};

/// The matrix as a file of the kind that `path` ends in: .clf (Academy/ASC Common LUT Format 3), .spimtx,
/// .cube. Description and provenance are inside, but in .spimtx, whose readers take twelve numbers and no
/// word. Usage for another ending or an impossible domain.
[[nodiscard]] Result<std::string> matrix_file_text(const BakedMatrix& baked, const std::string& path,
                                                   const CubeDomain& domain);

/// Writes it; the file appears complete, or not at all.
[[nodiscard]] Result<void> write_matrix_file(const BakedMatrix& baked, const std::string& path,
                                             const CubeDomain& domain);

}  // namespace osio::files
