// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_codec.h>
#include <formats/exr/zip_bytes.h>
#include <formats/exr/zip_codec.h>

#include <algorithm>
#include <string>

namespace osio::exr {

namespace {

class ZipChunkCodec final : public ChunkCodec {
  public:
    [[nodiscard]] Result<void> unpack(std::span<const std::uint8_t> packed, ChunkShape,
                                      std::span<std::uint8_t> lines) override {
        OSIO_TRY(const auto zipped, m_inflater.inflate(packed, lines.size()));
        UnzipCursor cursor = start_unzip(zipped);
        unzip(cursor, lines);
        return {};
    }

  private:
    Inflater m_inflater;
};

/// Runs of the bytes that ZIP gives to zlib. A run is a count c, signed, and its bytes: -c bytes as they
/// are where c < 0, else one byte c + 1 times. (OpenEXR's file layout; src/lib/OpenEXR/ImfRle.cpp.)
class RleChunkCodec final : public ChunkCodec {
  public:
    [[nodiscard]] Result<void> unpack(std::span<const std::uint8_t> packed, ChunkShape,
                                      std::span<std::uint8_t> lines) override {
        m_bytes.resize(lines.size());
        std::size_t at = 0, done = 0;
        while (at < packed.size()) {
            const auto run = static_cast<std::int8_t>(packed[at++]);
            const auto count = static_cast<std::size_t>(run < 0 ? -run : run + 1);
            const std::size_t taken = run < 0 ? count : 1;
            if (taken > packed.size() - at || count > m_bytes.size() - done)
                return fail(ErrorCode::Damaged,
                            "a chunk's run of " + std::to_string(count) + " bytes goes beyond its end");
            const auto to = m_bytes.begin() + static_cast<std::ptrdiff_t>(done);
            if (run < 0)
                std::copy_n(packed.begin() + static_cast<std::ptrdiff_t>(at), count, to);
            else
                std::fill_n(to, count, packed[at]);
            at += taken;
            done += count;
        }
        if (done != m_bytes.size())
            return fail(ErrorCode::Damaged, "a chunk unpacks to " + std::to_string(done) +
                                                " bytes, expected " + std::to_string(m_bytes.size()));
        UnzipCursor cursor = start_unzip(m_bytes);
        unzip(cursor, lines);
        return {};
    }

  private:
    std::vector<std::uint8_t> m_bytes;
};

class StoredChunkCodec final : public ChunkCodec {
  public:
    [[nodiscard]] Result<void> unpack(std::span<const std::uint8_t> packed, ChunkShape,
                                      std::span<std::uint8_t> lines) override {
        return fail(ErrorCode::Damaged, "a chunk of " + std::to_string(packed.size()) + " bytes, expected " +
                                            std::to_string(lines.size()));
    }
};

}  // namespace

std::unique_ptr<ChunkCodec> make_zip_codec() {
    return std::make_unique<ZipChunkCodec>();
}

std::unique_ptr<ChunkCodec> make_rle_codec() {
    return std::make_unique<RleChunkCodec>();
}

std::unique_ptr<ChunkCodec> make_stored_codec() {
    return std::make_unique<StoredChunkCodec>();
}

}  // namespace osio::exr
