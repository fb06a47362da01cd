// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_codec.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace osio::exr {

namespace {

constexpr std::size_t kSide = 4;          ///< a block has 4 x 4 halves
constexpr std::size_t kFlatBytes = 3;     ///< packed: all the same
constexpr std::size_t kPackedBytes = 14;  ///< packed: the first, a shift, 15 differences of 6 bits
constexpr unsigned kFlatShift = 13;       ///< from this shift on a block is flat

/// Halves in the order of their values, as unsigned numbers, back to their bits.
std::uint16_t half_bits(std::uint16_t ordered) {
    return static_cast<std::uint16_t>((ordered & 0x8000U) != 0 ? ordered & 0x7FFFU : ~unsigned{ordered});
}

std::uint64_t big_endian(const std::uint8_t* from) {
    std::uint64_t out = 0;
    for (std::size_t i = 0; i < sizeof out; ++i)
        out = out << 8 | from[i];
    return out;
}

using Block = std::array<std::uint16_t, kSide * kSide>;  ///< row after row

/// The 15 differences run down the first column, then along each row's second, third and fourth
/// samples, column by column; each is from the sample above in the first column, else from the one to
/// the left. (B44: OpenEXR's technical introduction; src/lib/OpenEXR/ImfB44Compressor.cpp.)
Block packed_block(const std::uint8_t* from) {
    const unsigned shift = from[2] >> 2;
    const unsigned bias = 0x20U << shift;
    // Numbers of 6 bits from from[2] on, the shift first: ten begin in its first 8 bytes, the rest in the last 8.
    const std::uint64_t front = big_endian(from + 2), back = big_endian(from + 6);
    const auto difference = [&](std::size_t i) {
        const std::uint64_t bits = i < 10 ? front >> (58 - 6 * i) : back >> (90 - 6 * i);
        return static_cast<unsigned>(bits & 0x3FU) << shift;
    };
    std::array<unsigned, kSide * kSide> ordered{};
    ordered[0] = unsigned{from[0]} << 8 | from[1];
    std::size_t next = 1;
    for (std::size_t row = 1; row < kSide; ++row)
        ordered[row * kSide] = (ordered[(row - 1) * kSide] + difference(next++) - bias) & 0xFFFFU;
    for (std::size_t column = 1; column < kSide; ++column)
        for (std::size_t row = 0; row < kSide; ++row)
            ordered[row * kSide + column] =
                (ordered[row * kSide + column - 1] + difference(next++) - bias) & 0xFFFFU;
    Block out;
    std::transform(ordered.begin(), ordered.end(), out.begin(),
                   [](unsigned value) { return half_bits(static_cast<std::uint16_t>(value)); });
    return out;
}

Block flat_block(const std::uint8_t* from) {
    Block out;
    out.fill(half_bits(static_cast<std::uint16_t>(unsigned{from[0]} << 8 | from[1])));
    return out;
}

class B44ChunkCodec final : public ChunkCodec {
  public:
    explicit B44ChunkCodec(std::vector<SampleType> channels) : m_channels(std::move(channels)) {
        for (const SampleType type : m_channels)
            m_pixel_bytes += sample_bytes(type);
    }

    /// Channels follow each other, not lines: halves in blocks, others as they are.
    [[nodiscard]] Result<void> unpack(std::span<const std::uint8_t> packed, ChunkShape shape,
                                      std::span<std::uint8_t> lines) override {
        std::uint8_t* to = lines.data();
        const std::size_t line_bytes = m_pixel_bytes * shape.width;
        for (const SampleType type : m_channels) {
            OSIO_CHECK_OK(type == SampleType::Half
                              ? unpack_halves(packed, shape, to, line_bytes)
                              : copy_words(packed, sample_bytes(type), shape, to, line_bytes));
            to += sample_bytes(type) * shape.width;
        }
        if (!packed.empty())
            return fail(ErrorCode::Damaged,
                        "a chunk has " + std::to_string(packed.size()) + " bytes behind its last block");
        return {};
    }

  private:
    static tl::unexpected<Error> too_short() {
        return fail(ErrorCode::Damaged, "a chunk ends within its blocks");
    }

    static Result<void> unpack_halves(std::span<const std::uint8_t>& packed, ChunkShape shape,
                                      std::uint8_t* to, std::size_t line_bytes) {
        for (std::size_t y = 0; y < shape.height; y += kSide)
            for (std::size_t x = 0; x < shape.width; x += kSide) {
                if (packed.size() < kFlatBytes)
                    return too_short();
                const bool flat = packed[2] >= kFlatShift << 2;
                if (!flat && packed.size() < kPackedBytes)
                    return too_short();
                const Block block = flat ? flat_block(packed.data()) : packed_block(packed.data());
                packed = packed.subspan(flat ? kFlatBytes : kPackedBytes);
                const std::size_t bytes = std::min(kSide, shape.width - x) * sizeof(std::uint16_t);
                for (std::size_t row = 0; row < std::min(kSide, shape.height - y); ++row)
                    std::memcpy(to + (y + row) * line_bytes + x * sizeof(std::uint16_t), &block[row * kSide],
                                bytes);
            }
        return {};
    }

    static Result<void> copy_words(std::span<const std::uint8_t>& packed, std::size_t word_bytes,
                                   ChunkShape shape, std::uint8_t* to, std::size_t line_bytes) {
        const std::size_t bytes = word_bytes * shape.width;
        if (packed.size() / shape.height < bytes)
            return too_short();
        for (std::size_t line = 0; line < shape.height; ++line)
            std::memcpy(to + line * line_bytes, packed.data() + line * bytes, bytes);
        packed = packed.subspan(bytes * shape.height);
        return {};
    }

    std::vector<SampleType> m_channels;
    std::size_t m_pixel_bytes = 0;
};

}  // namespace

std::unique_ptr<ChunkCodec> make_b44_codec(std::vector<SampleType> channels) {
    return std::make_unique<B44ChunkCodec>(std::move(channels));
}

}  // namespace osio::exr
