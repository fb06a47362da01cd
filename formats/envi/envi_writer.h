// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/envi/envi_header.h>
#include <formats/files/replacement_file.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace osio::envi {

/// A cube to be written: floats, in the machine's byte order.
struct EnviOutput {
    std::size_t samples = 0, lines = 0;
    Interleave interleave = Interleave::Bsq;
    Quantity quantity = Quantity::Reflectance;
    std::vector<double> wavelengths_nm;  ///< one a band
    std::vector<double> fwhm_nm;         ///< one a band, or none
    std::vector<Field> fields;           ///< all else
};

/// The text of its header; parse_header() understands it as what it came from.
[[nodiscard]] std::string header_text(const EnviOutput& output);

/// Where the data of a header would lie: of `cube.dat.hdr` in `cube.dat`, of `cube.hdr` in `cube.img`, or where the
/// header that it replaces has its own. Usage where another file is in the way, which would be taken for
/// the data.
[[nodiscard]] Result<std::string> data_path_for(const std::string& header_path);

/// Writes a header and its data file, rows from top to bottom, each into a temporary beside its target. Both
/// take their places in finish(), or neither does.
class EnviWriter {
  public:
    [[nodiscard]] static Result<std::unique_ptr<EnviWriter>> create(const std::string& header_path,
                                                                    EnviOutput output);

    EnviWriter(const EnviWriter&) = delete;
    EnviWriter& operator=(const EnviWriter&) = delete;
    ~EnviWriter();

    [[nodiscard]] const std::string& data_path() const;

    /// The next rows: for each band a plane of row_count x samples floats.
    [[nodiscard]] Result<void> write_rows(int row_count, std::span<const float* const> planes);

    /// Fails where rows are missing or the system could not take every byte.
    [[nodiscard]] Result<void> finish(files::Durability durability = files::Durability::Handed);

  private:
    struct State;
    explicit EnviWriter(std::unique_ptr<State> state);

    std::unique_ptr<State> m_state;
};

}  // namespace osio::envi
