// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/limits.h>

#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <string>

namespace osio::exr {

namespace {

tl::unexpected<Error> too_much(const std::string& what, std::uint64_t found, std::uint64_t most) {
    return fail(ErrorCode::Damaged, what + " of " + std::to_string(found) +
                                        " bytes, more than the limit of " + std::to_string(most));
}

std::uint64_t chunks_of(std::int64_t pixels, std::uint64_t step) {
    return (static_cast<std::uint64_t>(pixels) + step - 1) / step;
}

}  // namespace

int lines_of_chunk(Imf::Compression compression) {
    switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION: return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION: return 16;
    case Imf::DWAB_COMPRESSION: return 256;
    default: return 32;
    }
}

std::uint64_t most_expansion(Imf::Compression compression) {
    constexpr std::uint64_t kDeflate = 258 * 8 / 2;
    switch (compression) {
    case Imf::NO_COMPRESSION: return 1;
    case Imf::RLE_COMPRESSION: return 128 / 2;
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION: return kDeflate;
    case Imf::PXR24_COMPRESSION: return kDeflate * 4 / 3;
    case Imf::PIZ_COMPRESSION: return 256 * 2 * 8 / 9 + 1;
    case Imf::B44_COMPRESSION: return 32 / 14 + 1;
    case Imf::B44A_COMPRESSION: return 32 / 3 + 1;
    default: return kDeflate * 64;
    }
}

std::uint64_t sample_bytes_of(const image::Part& part, std::uint64_t width, std::uint64_t height) {
    std::uint64_t pixel = 0;
    for (const image::Channel& channel : part.channels)
        pixel += sample_bytes(channel.type);
    return width * height * pixel;
}

ChunkSize chunk_size(const image::Part& part) {
    if (part.tiled) {
        const Imf::TileDescription& tiles = part.header.tileDescription();
        return {tiles.xSize, tiles.ySize};
    }
    return {static_cast<std::uint64_t>(part.data_window.width()),
            static_cast<std::uint64_t>(lines_of_chunk(part.header.compression()))};
}

std::uint64_t full_resolution_chunks(const image::Part& part) {
    const ChunkSize size = chunk_size(part);
    return chunks_of(part.data_window.width(), size.width) *
           chunks_of(part.data_window.height(), size.height);
}

ChunkSize header_chunk(const Imf::Header& header) {
    if (header.hasTileDescription())
        return {header.tileDescription().xSize, header.tileDescription().ySize};
    const Imath::Box2i& window = header.dataWindow();
    return {static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1),
            static_cast<std::uint64_t>(lines_of_chunk(header.compression()))};
}

std::uint64_t header_chunks(const Imf::Header& header) {
    const Imath::Box2i& window = header.dataWindow();
    const ChunkSize size = header_chunk(header);
    return chunks_of(std::int64_t{window.max.x} - window.min.x + 1, size.width) *
           chunks_of(std::int64_t{window.max.y} - window.min.y + 1, size.height);
}

Result<void> check_limits(const image::Part& part, std::uint64_t file_bytes) {
    const auto width = static_cast<std::uint64_t>(part.data_window.width());
    const auto height = static_cast<std::uint64_t>(part.data_window.height());
    const ChunkSize chunk = chunk_size(part);
    if (chunk.width == 0 || chunk.height == 0 || chunk.width > image::kMostSidePixels ||
        chunk.height > image::kMostSidePixels)
        return fail(ErrorCode::Damaged, "tiles of " + std::to_string(chunk.width) + "x" +
                                            std::to_string(chunk.height) + " pixels");
    if (part.deep)
        return {};
    // Two sides stay below 2^60, and with 2^18 bytes a pixel below 2^63: nothing overflows.
    constexpr std::uint64_t kMostPixels = image::kMostPartBytes / 2;
    if (width * height > kMostPixels || chunk.width * chunk.height > kMostPixels)
        return fail(ErrorCode::Damaged, "has a part or a tile of more than " + std::to_string(kMostPixels) +
                                            " pixels, more than the limit");
    const std::uint64_t whole = sample_bytes_of(part, width, height);
    const std::uint64_t one = part.tiled ? sample_bytes_of(part, chunk.width, chunk.height)
                                         : sample_bytes_of(part, width, std::min(height, chunk.height));
    if (whole > image::kMostPartBytes)
        return too_much("a part", whole, image::kMostPartBytes);
    if (one > kMostChunkBytes)
        return too_much(part.tiled ? "a tile" : "a chunk", one, kMostChunkBytes);
    const std::uint64_t held = std::max(kFreeBytes, most_expansion(part.header.compression()) * file_bytes);
    const bool subsampled = std::any_of(part.channels.begin(), part.channels.end(),
                                        [](const image::Channel& channel) { return channel.subsampled; });
    if (std::max(subsampled ? 0 : whole, one) > held)
        return fail(ErrorCode::Damaged, "claims " + std::to_string(std::max(whole, one)) +
                                            " bytes of pixels, more than " + std::to_string(file_bytes) +
                                            " bytes of " + part.compression +
                                            " can hold; the file is cut short or damaged");
    return {};
}

}  // namespace osio::exr
