// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/spectrum.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

/// The colour tables of `data/`, compiled in. Where each came from is in `data/sources.tsv`.
namespace osio {

/// One CSV file of `data/`: a wavelength column and one or more columns of values.
struct Table {
    std::string_view file;                      ///< path below `data/`
    std::string_view sha256;                    ///< of the file's bytes
    std::span<const std::string_view> columns;  ///< names, without the wavelength column
    std::span<const std::string_view> sources;  ///< one for each column
    std::span<const double> wavelengths_nm;     ///< strictly increasing
    std::span<const double> cells;              ///< by rows, columns.size() a row

    /// One column as a curve; nothing when no column has that name (case ignored).
    [[nodiscard]] std::optional<Spectrum> column(std::string_view name) const;
};

/// All tables, in the order of their file names.
[[nodiscard]] std::span<const Table> embedded_tables();

/// The table of that path below `data/`; nothing when there is none.
[[nodiscard]] const Table* find_table(std::string_view file);

}  // namespace osio
