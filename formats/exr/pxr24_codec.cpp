// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_codec.h>
#include <formats/exr/zip_codec.h>

#include <bit>
#include <cstring>

namespace osio::exr {

namespace {

static_assert(std::endian::native == std::endian::little, "lines are little-endian");

/// Bytes of a sample before zlib: floats have lost their lowest 8 bits.
std::size_t kept_bytes(SampleType type) {
    switch (type) {
    case SampleType::Half: return 2;
    case SampleType::Float: return 3;
    case SampleType::Uint: break;
    }
    return 4;
}

/// One channel of a line: kBytes planes of `count` bytes, the highest byte's first, of the differences
/// between neighbours, whose running sum is the samples. (Pxr24: OpenEXR's technical introduction;
/// src/lib/OpenEXR/ImfPxr24Compressor.cpp.)
template <class Sample, std::size_t kBytes>
void add_up(const std::uint8_t* planes, std::size_t count, std::uint8_t* out) {
    Sample sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Sample difference = 0;
        for (std::size_t byte = 0; byte < kBytes; ++byte)
            difference = static_cast<Sample>(difference | static_cast<Sample>(planes[byte * count + i])
                                                              << (8 * (sizeof(Sample) - 1 - byte)));
        sum = static_cast<Sample>(sum + difference);
        std::memcpy(out + i * sizeof sum, &sum, sizeof sum);
    }
}

class Pxr24ChunkCodec final : public ChunkCodec {
  public:
    explicit Pxr24ChunkCodec(std::vector<SampleType> channels) : m_channels(std::move(channels)) {
        for (const SampleType type : m_channels)
            m_pixel_bytes += kept_bytes(type);
    }

    [[nodiscard]] Result<void> unpack(std::span<const std::uint8_t> packed, ChunkShape shape,
                                      std::span<std::uint8_t> lines) override {
        OSIO_TRY(const auto kept, m_inflater.inflate(packed, m_pixel_bytes * shape.width * shape.height));
        const std::uint8_t* from = kept.data();
        std::uint8_t* to = lines.data();
        for (std::size_t line = 0; line < shape.height; ++line)
            for (const SampleType type : m_channels) {
                switch (type) {
                case SampleType::Half: add_up<std::uint16_t, 2>(from, shape.width, to); break;
                case SampleType::Float: add_up<std::uint32_t, 3>(from, shape.width, to); break;
                case SampleType::Uint: add_up<std::uint32_t, 4>(from, shape.width, to); break;
                }
                from += kept_bytes(type) * shape.width;
                to += sample_bytes(type) * shape.width;
            }
        return {};
    }

  private:
    std::vector<SampleType> m_channels;
    std::size_t m_pixel_bytes = 0;
    Inflater m_inflater;
};

}  // namespace

std::unique_ptr<ChunkCodec> make_pxr24_codec(std::vector<SampleType> channels) {
    return std::make_unique<Pxr24ChunkCodec>(std::move(channels));
}

}  // namespace osio::exr
