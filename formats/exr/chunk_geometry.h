// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/exr_file.h>

#include <cstdint>

namespace osio::exr {

/// Lines of a chunk of scanlines, as the format fixes them for each compression.
[[nodiscard]] int lines_of_chunk(Imf::Compression compression);

/// How many unpacked bytes one stored byte can become at most; what claims more is damaged. None: 1.
/// RLE: 128 from 2. Deflate: 258 from 2 bits (RFC 1951). PXR24: the same, and 3 bytes stand for 4. PIZ: 256
/// words from the 9 bits of a run. B44A: 32 from 3, B44: 32 from 14. DWA: 64 coefficients of zero are
/// one symbol of 2 bytes, deflated.
[[nodiscard]] std::uint64_t most_expansion(Imf::Compression compression);

/// Bytes of the samples in a box of pixels, sub-sampled channels counted as if they were whole.
[[nodiscard]] std::uint64_t sample_bytes_of(const image::Part& part, std::uint64_t width,
                                            std::uint64_t height);

/// Width and height of the part's chunks before the window cuts them: tiles, or lines.
struct ChunkSize {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
};

[[nodiscard]] ChunkSize chunk_size(const image::Part& part);

/// Chunks of the part's full resolution, which come first in its table.
[[nodiscard]] std::uint64_t full_resolution_chunks(const image::Part& part);

/// The same for a header of its own, of scanlines or of tiles of one level.
[[nodiscard]] ChunkSize header_chunk(const Imf::Header& header);
[[nodiscard]] std::uint64_t header_chunks(const Imf::Header& header);

/// Refuses (Damaged) windows, tiles and sums of bytes beyond our limits, and more than a file of
/// `file_bytes` can hold.
[[nodiscard]] Result<void> check_limits(const image::Part& part, std::uint64_t file_bytes);

}  // namespace osio::exr
