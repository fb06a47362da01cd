// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>
#include <osio/collapse/plan.h>
#include <osio/colour/difference.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// Conversions of colour that a 3x3 matrix can say, without spectra at hand.
enum class MatrixKind {
    Adaptation,  ///< XYZ under one light to XYZ under another, by a chromatic adaptation: exact
    Primaries,   ///< one linear space to another: exact
    Relight,     ///< XYZ of reflectances under one light to XYZ under another: fitted
    Observer,    ///< XYZ of one observer to XYZ of another: fitted
    Camera,      ///< a camera's R, G, B to a linear space: fitted
};

/// What to bake.
struct MatrixRequest {
    MatrixKind kind{};
    std::string from;          ///< a light, space, observer or camera's table, by kind
    std::string to;            ///< the same; of a camera a space
    std::string illuminant;    ///< Observer, Camera: the light on the reflectances; empty: D65
    std::string observer;      ///< Adaptation, Relight, Camera; empty: cie1931
    std::string reflectances;  ///< fits; "colorchecker" (empty too), or a .csv: nm, one column a spectrum
    std::optional<Adaptation> adaptation;  ///< Adaptation, Primaries, Camera; nothing: Bradford
    bool keep_white = false;               ///< of fits: the perfect diffuser comes out exactly
};

/// A table that took part.
struct UsedTable {
    std::string role;  ///< "from light", "observer", "reflectances", ...
    std::string name;
    std::string source;
    std::string digest;
};

struct BakedMatrix {
    Matrix3 matrix;
    std::string title;                    ///< one line: from what to what
    std::string input, output;            ///< what three numbers are before and after
    std::optional<DifferenceSummary> residual;  ///< of fitted matrices
    std::size_t fitted_spectra = 0;
    std::vector<UsedTable> tables;

    /// Title, residual and tables, a line each.
    [[nodiscard]] std::vector<std::string> description() const;
};

/// "adaptation", "primaries", "relight", "observer", "camera".
[[nodiscard]] std::string_view matrix_kind_name(MatrixKind kind);
[[nodiscard]] Result<MatrixKind> find_matrix_kind(std::string_view name);

/// Computes the matrix. Fits are least squares over the set (of a camera on the space's R, G, B); the
/// residual is CIEDE2000 under the white of the target. Relight and Observer do not adapt: white becomes
/// the other light's or observer's white. Usage for words that the kind has no use for and for spaces
/// that are not linear red, green, blue or XYZ under D65; refusals of tables.
[[nodiscard]] Result<BakedMatrix> bake_matrix(const MatrixRequest& request, const TextLoader& load_text);

}  // namespace osio
