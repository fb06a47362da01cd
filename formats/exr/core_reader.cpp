// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/block_buffer.h>
#include <formats/exr/block_readers.h>

#include <OpenEXR/openexr_chunkio.h>
#include <OpenEXR/openexr_decode.h>
#include <OpenEXR/openexr_part.h>
#include <OpenEXR/openexr_std_attr.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

namespace osio::exr {

namespace {

/// Where a chunk's pixels go in the block.
struct Place {
    int column = 0;
    int row = 0;
    int width = 0;  ///< pixels that the grid expects
    int height = 0;
};

class CoreReader final : public BlockReader {
  public:
    explicit CoreReader(const BlockJob& job)
        : m_job(job), m_part(job.file->parts()[job.part]), m_buffer(m_part, job.planes, job.grid) {}

    CoreReader(const CoreReader&) = delete;
    CoreReader& operator=(const CoreReader&) = delete;

    ~CoreReader() override {
        if (m_initialised)
            exr_decoding_destroy(context(), &m_decode);
    }

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const int first = m_job.grid.first_row(block);
        const int count = m_job.grid.row_count(block);
        if (m_part.tiled)
            OSIO_CHECK_OK(read_tiles(static_cast<int>(block), count));
        else
            OSIO_CHECK_OK(read_scanlines(first, count));
        return m_buffer.block(first, count);
    }

  private:
    [[nodiscard]] exr_const_context_t context() const { return m_job.file->context(); }

    [[nodiscard]] int part_index() const { return static_cast<int>(m_job.part); }

    [[nodiscard]] tl::unexpected<Error> damaged(std::string what) const {
        return fail(ErrorCode::Damaged, std::move(what), m_job.file->path());
    }

    Result<void> read_scanlines(int first, int count) {
        for (int row = 0; row < count;) {
            exr_chunk_info_t chunk{};
            const auto code = exr_read_scanline_chunk_info(context(), part_index(), first + row, &chunk);
            if (code != EXR_ERR_SUCCESS)
                return core_failure(code, m_job.file->path());
            const Place place{0, row, m_job.grid.window.width(), std::min(chunk.height, count - row)};
            OSIO_CHECK_OK(decode(chunk, place));
            row += chunk.height;
        }
        return {};
    }

    Result<void> read_tiles(int tile_row, int count) {
        int32_t tile_width = 0, tile_height = 0;
        exr_get_tile_sizes(context(), part_index(), 0, 0, &tile_width, &tile_height);
        for (int column = 0; column < m_job.grid.window.width(); column += tile_width) {
            exr_chunk_info_t chunk{};
            const auto code = exr_read_tile_chunk_info(context(), part_index(), column / tile_width, tile_row,
                                                       0, 0, &chunk);
            if (code != EXR_ERR_SUCCESS)
                return core_failure(code, m_job.file->path());
            const int width = std::min(tile_width, m_job.grid.window.width() - column);
            OSIO_CHECK_OK(decode(chunk, {column, 0, width, count}));
        }
        return {};
    }

    Result<void> decode(const exr_chunk_info_t& chunk, const Place& place) {
        if (chunk.width != place.width || chunk.height != place.height)
            return damaged("a chunk has another size than the header gives it");
        // Without compression Core 3.1.5 trusts the header and not the chunk's own length.
        if (chunk.compression == EXR_COMPRESSION_NONE && chunk.packed_size != chunk.unpacked_size)
            return damaged("a chunk of " + std::to_string(chunk.packed_size) + " bytes, expected " +
                           std::to_string(chunk.unpacked_size));
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
            return core_failure(code, m_job.file->path());
        return {};
    }

    /// Finds the plane of each of the decoder's channels, which are in the order of the file.
    void match_channels() {
        std::map<std::string, std::size_t, std::less<>> planes;
        for (std::size_t plane = 0; plane < m_job.planes.size(); ++plane)
            if (m_job.planes[plane])
                planes[m_part.channels[*m_job.planes[plane]].name] = plane;
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
            const std::size_t offset =
                static_cast<std::size_t>(place.row) * static_cast<std::size_t>(m_job.grid.window.width()) +
                static_cast<std::size_t>(place.column);
            channel.decode_to_ptr = reinterpret_cast<uint8_t*>(m_buffer.plane(*plane) + offset * bytes);
            channel.user_data_type = channel.data_type;
            channel.user_bytes_per_element = channel.bytes_per_element;
            channel.user_pixel_stride = static_cast<int32_t>(bytes);
            channel.user_line_stride = channel.user_pixel_stride * m_job.grid.window.width();
        }
    }

    BlockJob m_job;
    const ExrPart& m_part;
    BlockBuffer m_buffer;
    std::vector<std::optional<std::size_t>> m_planes;  ///< by the decoder's channels
    exr_decode_pipeline_t m_decode = EXR_DECODE_PIPELINE_INITIALIZER;
    bool m_initialised = false;
};

}  // namespace

Result<std::unique_ptr<BlockReader>> make_core_reader(const BlockJob& job) {
    return std::make_unique<CoreReader>(job);
}

}  // namespace osio::exr
