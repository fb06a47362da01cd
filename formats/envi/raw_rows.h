// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_file.h>

#include <osio/collapse/stream.h>

#include <cstddef>
#include <span>

namespace osio::envi {

/// Rows, both ends inside, as interleaved pixels of the file's own type in the machine's byte order: for each
/// pixel a number of each of `bands`, unscaled, bit for bit. `out` takes rows x samples x bands numbers.
/// Damaged where the data file has become shorter.
[[nodiscard]] Result<void> read_raw_rows(const EnviFile& file, RowRange rows,
                                         std::span<const std::size_t> bands, std::byte* out);

}  // namespace osio::envi
