// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_reader.h>

#include <OpenEXR/openexr_decode.h>

#include <bench/core_reader.h>
#include <functional>
#include <map>
#include <string>

namespace osio::exr {

namespace {

class CoreReader final : public ChunkReader {
  public:
    using ChunkReader::ChunkReader;
    CoreReader(const CoreReader&) = delete;
    CoreReader& operator=(const CoreReader&) = delete;

    ~CoreReader() override {
        if (m_initialised)
            exr_decoding_destroy(context(), &m_decode);
    }

  private:
    [[nodiscard]] Result<void> decode(const exr_chunk_info_t& chunk, const Place& place) override {
        // Without compression Core 3.1.5 trusts the header and not the chunk's own length.
        if (chunk.compression == EXR_COMPRESSION_NONE && chunk.packed_size != chunk.unpacked_size)
            return fail(ErrorCode::Damaged,
                        "a chunk of " + std::to_string(chunk.packed_size) + " bytes, expected " +
                            std::to_string(chunk.unpacked_size),
                        path());
        auto code = m_initialised ? exr_decoding_update(context(), part_index(), &chunk, &m_decode)
                                  : exr_decoding_initialize(context(), part_index(), &chunk, &m_decode);
        if (code == EXR_ERR_SUCCESS) {
            if (!m_initialised)
                match_channels();
            point_channels(place);
            if (!m_initialised)
                code = exr_decoding_choose_default_routines(context(), part_index(), &m_decode);
            m_initialised = true;
        }
        if (code == EXR_ERR_SUCCESS)
            code = exr_decoding_run(context(), part_index(), &m_decode);
        if (code != EXR_ERR_SUCCESS)
            return core_failure(code, path());
        return {};
    }

    /// Finds the plane of each of the decoder's channels, which are in the order of the file.
    void match_channels() {
        std::map<std::string, std::size_t, std::less<>> planes;
        for (std::size_t plane = 0; plane < job().planes.size(); ++plane)
            if (job().planes[plane])
                planes[part().channels[*job().planes[plane]].name] = plane;
        for (int c = 0; c < m_decode.channel_count; ++c) {
            const auto found = planes.find(m_decode.channels[c].channel_name);
            m_planes.push_back(found == planes.end() ? std::nullopt : std::optional(found->second));
        }
    }

    void point_channels(const Place& place) {
        for (int c = 0; c < m_decode.channel_count; ++c) {
            exr_coding_channel_info_t& channel = m_decode.channels[c];
            const auto plane = m_planes[static_cast<std::size_t>(c)];
            if (!plane) {
                channel.decode_to_ptr = nullptr;
                continue;
            }
            const auto bytes = static_cast<std::size_t>(channel.bytes_per_element);
            channel.decode_to_ptr = reinterpret_cast<uint8_t*>(target(*plane, bytes, place, 0));
            channel.user_data_type = channel.data_type;
            channel.user_bytes_per_element = channel.bytes_per_element;
            channel.user_pixel_stride = static_cast<int32_t>(bytes);
            channel.user_line_stride = channel.user_pixel_stride * job().grid.window.width();
        }
    }

    std::vector<std::optional<std::size_t>> m_planes;  ///< by the decoder's channels
    exr_decode_pipeline_t m_decode = EXR_DECODE_PIPELINE_INITIALIZER;
    bool m_initialised = false;
};

}  // namespace

Result<std::unique_ptr<BlockReader>> make_core_reader(const BlockJob& job) {
    return std::make_unique<CoreReader>(job);
}

}  // namespace osio::exr
