// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>

#include <OpenEXR/ImfCompression.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace osio::exr {

/// The pixels of a chunk.
struct ChunkShape {
    std::size_t width = 0;
    std::size_t height = 0;
};

/// Turns packed chunks of one compression into lines: in each the part's channels one after the other,
/// each a run of little-endian samples. One for each worker; memory is reused.
class ChunkCodec {
  public:
    virtual ~ChunkCodec() = default;

    /// Fills `lines`, which has the size that the shape and the channels need. `packed` is smaller: as many
    /// bytes are lines that were stored as they are. Damaged where the packed bytes are broken, or make
    /// fewer or more than `lines`.
    [[nodiscard]] virtual Result<void> unpack(std::span<const std::uint8_t> packed, ChunkShape shape,
                                              std::span<std::uint8_t> lines) = 0;
};

/// ZIP, ZIPS.
[[nodiscard]] std::unique_ptr<ChunkCodec> make_zip_codec();
[[nodiscard]] std::unique_ptr<ChunkCodec> make_rle_codec();
[[nodiscard]] std::unique_ptr<ChunkCodec> make_pxr24_codec(std::vector<SampleType> channels);
/// B44, B44A.
[[nodiscard]] std::unique_ptr<ChunkCodec> make_b44_codec(std::vector<SampleType> channels);
/// For chunks that are always stored as they are: refuses others.
[[nodiscard]] std::unique_ptr<ChunkCodec> make_stored_codec();

}  // namespace osio::exr
