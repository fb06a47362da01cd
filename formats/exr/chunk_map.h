// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/checksum.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/raw_header.h>
#include <formats/files/raw_file.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osio::exr {

/// Where the chunks of a file lie, read from its tables, and whether each is where, what and as large as
/// the header says. OpenEXR checks some of this; here all of it is, for every way of reading.
class ChunkMap {
  public:
    /// Reads the tables. `counts`: chunks of each part. Damaged where they do not fit the file or the
    /// windows, or where the header's own checksum differs.
    [[nodiscard]] static Result<std::shared_ptr<const ChunkMap>>
    load(files::RawFile file, const RawHeaders& headers, const std::vector<image::Part>& parts,
         const std::vector<std::uint64_t>& counts);

    /// Looks at one chunk of a flat part: inside the file, apart from others, with the coordinates that
    /// its place in the table implies, no larger than what it unpacks to, and its checksum. `scratch` is
    /// memory to be used again.
    [[nodiscard]] Result<void> check(std::size_t part, std::uint64_t chunk, std::string& scratch) const;

    /// The first chunk of a part and how many its full resolution has.
    [[nodiscard]] std::uint64_t chunk_count(std::size_t part) const { return m_parts[part].full; }

    /// The chunks that hold rows, both ends inside.
    struct Range {
        std::uint64_t begin = 0, end = 0;
    };

    [[nodiscard]] Range chunks_of_rows(std::size_t part, int first, int last) const;

    enum class Sum {
        None,     ///< the file has no checksum
        Foreign,  ///< it has one of another file: other software wrote it again
        Own,
    };

    [[nodiscard]] Sum checksum() const { return m_sum; }

  private:
    struct Part {
        std::vector<std::uint64_t> offsets;
        std::vector<std::uint64_t> sums;  ///< where the file has checksums of its own
        std::uint64_t full = 0;           ///< chunks of the full resolution
        std::uint64_t columns = 1;        ///< tiles across
        std::int64_t lines = 0;           ///< rows of a chunk
        std::int64_t min_y = 0, max_y = 0;
        std::uint64_t most_bytes = 0;  ///< a chunk unpacked
        bool tiled = false;
    };

    explicit ChunkMap(files::RawFile file) : m_file(std::move(file)) {}

    [[nodiscard]] Result<void> read_tables(std::uint64_t at, const std::vector<image::Part>& parts,
                                           const std::vector<std::uint64_t>& counts);
    [[nodiscard]] Result<void> adopt_checksum(const RawHeaders& headers);
    [[nodiscard]] std::size_t chunk_header_bytes(const Part& part) const;
    [[nodiscard]] Result<void> check_header(std::size_t part, std::uint64_t chunk,
                                            std::string_view header) const;

    files::RawFile m_file;
    bool m_multi_part = false;
    std::vector<Part> m_parts;
    std::vector<std::uint64_t> m_sorted;  ///< all offsets, then the end of the file
    std::uint64_t m_pixels_at = 0;        ///< where the tables end
    Sum m_sum = Sum::None;
};

}  // namespace osio::exr
