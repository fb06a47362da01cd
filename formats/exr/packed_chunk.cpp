// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/packed_chunk.h>

#include <OpenEXR/ImfChannelList.h>

#include <string>

namespace osio::exr {

namespace {

std::unique_ptr<ChunkCodec> codec_of(const image::Part& part) {
    std::vector<SampleType> channels;
    for (const image::Channel& channel : part.channels)
        channels.push_back(channel.type);
    switch (part.header.compression()) {
    case Imf::NO_COMPRESSION: return make_stored_codec();
    case Imf::RLE_COMPRESSION: return make_rle_codec();
    case Imf::ZIPS_COMPRESSION:
    case Imf::ZIP_COMPRESSION: return make_zip_codec();
    case Imf::PXR24_COMPRESSION: return make_pxr24_codec(std::move(channels));
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION: return make_b44_codec(std::move(channels));
    default: return nullptr;
    }
}

/// B44 keeps what is called perceptually linear as its logarithm, which only the C++ API undoes.
bool is_logarithmic(const image::Part& part) {
    const auto compression = part.header.compression();
    if (compression != Imf::B44_COMPRESSION && compression != Imf::B44A_COMPRESSION)
        return false;
    const Imf::ChannelList& channels = part.header.channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        if (channel.channel().pLinear)
            return true;
    return false;
}

}  // namespace

bool has_own_codec(const image::Part& part) {
    return codec_of(part) != nullptr && !is_logarithmic(part);
}

std::vector<LineChannel> line_channels(const image::Part& part, const PlaneChannels& planes) {
    std::vector<LineChannel> out;
    for (const image::Channel& channel : part.channels)
        out.push_back({channel.type, std::nullopt});
    for (std::size_t plane = 0; plane < planes.size(); ++plane)
        if (planes[plane])
            out[*planes[plane]].plane = plane;
    return out;
}

std::size_t pixel_bytes(const std::vector<LineChannel>& channels) {
    std::size_t bytes = 0;
    for (const LineChannel& channel : channels)
        bytes += sample_bytes(channel.type);
    return bytes;
}

PackedChunk::PackedChunk(const BlockJob& job)
    : m_file(job.file), m_part(static_cast<int>(job.part)), m_codec(codec_of(job.file->parts()[job.part])) {}

Result<void> PackedChunk::unpack(const exr_chunk_info_t& chunk, ChunkShape shape,
                                 std::span<std::uint8_t> lines) {
    if (chunk.packed_size == 0 || chunk.packed_size > lines.size())
        return fail(ErrorCode::Damaged,
                    "a chunk of " + std::to_string(chunk.packed_size) + " bytes, expected 1 to " +
                        std::to_string(lines.size()),
                    m_file->path());
    const bool stored = chunk.packed_size == lines.size();
    if (!stored)
        m_packed.resize(chunk.packed_size);
    const auto code =
        exr_read_chunk(m_file->context(), m_part, &chunk, stored ? lines.data() : m_packed.data());
    if (code != EXR_ERR_SUCCESS)
        return core_failure(code, m_file->path());
    if (stored)
        return {};
    if (auto unpacked = m_codec->unpack(m_packed, shape, lines); !unpacked)
        return fail_in(m_file->path(), std::move(unpacked).error());
    return {};
}

}  // namespace osio::exr
