// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/image/header_attributes.h>

#include <osio/layout/spectral_metadata.h>

#include <OpenEXR/ImfIO.h>

#include <algorithm>
#include <array>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace osio::exr {

namespace {

constexpr std::uint64_t kVersion = 1;
constexpr std::size_t kFixedBytes = 24;
constexpr std::size_t kHashBytes = 8;

void append_number(std::uint64_t value, std::string& out) {
    for (int shift = 0; shift < 64; shift += 8)
        out.push_back(static_cast<char>(value >> shift));
}

/// Bytes as an attribute of the checksum's type.
class ChecksumAttribute final : public Imf::Attribute {
  public:
    explicit ChecksumAttribute(std::string bytes) : m_bytes(std::move(bytes)) {}

    [[nodiscard]] const char* typeName() const override { return attribute::kChecksumType; }

    [[nodiscard]] Attribute* copy() const override { return new ChecksumAttribute(m_bytes); }

    void writeValueTo(Imf::OStream& stream, int) const override {
        stream.write(m_bytes.data(), static_cast<int>(m_bytes.size()));
    }

    void readValueFrom(Imf::IStream& stream, int size, int) override {
        m_bytes.resize(static_cast<std::size_t>(size));
        stream.read(m_bytes.data(), size);
    }

    void copyValueFrom(const Attribute& other) override {
        if (const auto* same = dynamic_cast<const ChecksumAttribute*>(&other))
            m_bytes = same->m_bytes;
    }

  private:
    std::string m_bytes;
};

bool decides_pixels(std::string_view name) {
    constexpr std::array<std::string_view, 10> kStructure{
        "channels", "compression", "dataWindow", "displayWindow", "lineOrder",
        "tiles",    "type",        "version",    "chunkCount",    "chromaticities"};
    return std::find(kStructure.begin(), kStructure.end(), name) != kStructure.end() ||
           describes_bands(name) || (name.starts_with("spectral") && name != attribute::kChecksum);
}

}  // namespace

std::optional<Checksum> Checksum::parse(std::string_view value) {
    if (value.size() < kFixedBytes || value.size() % kHashBytes != 0 ||
        little_endian(value, 0, 8) != kVersion)
        return std::nullopt;
    Checksum out{little_endian(value, 8, 8), little_endian(value, 16, 8), {}};
    for (std::size_t at = kFixedBytes; at < value.size(); at += kHashBytes)
        out.chunks.push_back(little_endian(value, at, kHashBytes));
    return out;
}

std::string Checksum::bytes() const {
    std::string out;
    for (const std::uint64_t number : {kVersion, file_bytes, header})
        append_number(number, out);
    for (const std::uint64_t chunk : chunks)
        append_number(chunk, out);
    return out;
}

std::uint64_t chunk_checksum(std::string_view stored) {
    return XXH3_64bits(stored.data(), stored.size());
}

std::uint64_t header_checksum(std::string_view version, const RawHeader& header) {
    std::string bytes(version);
    for (const RawAttribute& attribute : header) {
        if (!decides_pixels(attribute.name))
            continue;
        for (const std::string_view piece : {attribute.name, attribute.type, attribute.value}) {
            append_number(piece.size(), bytes);
            bytes += piece;
        }
    }
    return XXH3_64bits(bytes.data(), bytes.size());
}

const RawAttribute* find_checksum(const RawHeader& header) {
    for (const RawAttribute& attribute : header)
        if (attribute.name == attribute::kChecksum && attribute.type == attribute::kChecksumType)
            return &attribute;
    return nullptr;
}

void reserve_checksum(std::size_t chunk_count, Imf::Header& header) {
    image::erase_attributes({attribute::kChecksum}, header);
    Checksum empty;
    empty.chunks.resize(chunk_count);
    header.insert(attribute::kChecksum, ChecksumAttribute(empty.bytes()));
}

}  // namespace osio::exr
