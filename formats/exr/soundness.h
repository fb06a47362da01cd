// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/block_source.h>
#include <formats/exr/exr_file.h>

#include <osio/collapse/stream.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace osio::exr {

/// Rows that cannot be decoded, both ends inside, and why the first of them cannot.
struct BadRows {
    RowRange rows;
    std::string why;
};

/// Decodes every row of a source on the runner's workers and returns the ones that are damaged, from
/// top to bottom, neighbours together; empty where all is sound. Other failures (Io, Cancelled) are
/// errors. The finer the source's blocks, the fewer rows are called bad.
[[nodiscard]] Result<std::vector<BadRows>> find_bad_rows(const BlockSource& source, RowRange rows,
                                                         Runner& runner, const Progress& progress);

/// What became of one part when all of it was decoded.
struct PartSoundness {
    bool decoded = false;                  ///< false for deep parts, of which only the header was read
    std::vector<std::string> not_decoded;  ///< what else was left out, in words
    std::vector<BadRows> bad;

    [[nodiscard]] bool sound() const { return bad.empty(); }
};

/// Decodes all channels of a part, as far as this reader can, chunk by chunk.
[[nodiscard]] Result<PartSoundness> examine_part(const std::shared_ptr<const ExrFile>& file, std::size_t part,
                                                 Runner& runner, const Progress& progress);

/// The source with its bad rows black: samples of 0 in every plane, alpha too. `bad` are those that
/// find_bad_rows() found in it.
[[nodiscard]] std::unique_ptr<BlockSource>
with_black_rows(std::unique_ptr<BlockSource> source, std::vector<BadRows> bad, std::vector<SampleType> types);

/// Says in a header which rows are black because they were damaged; nothing where none is.
void note_missing_rows(const std::vector<BadRows>& bad, Imf::Header& header);

/// "16-31,48-63".
[[nodiscard]] std::string rows_text(const std::vector<BadRows>& bad);

/// How many rows.
[[nodiscard]] std::size_t row_count(const std::vector<BadRows>& bad);

}  // namespace osio::exr
