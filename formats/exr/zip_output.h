// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/output_rows.h>
#include <formats/exr/zip_codec.h>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace osio::exr {

/// Rows on their way into a file: whole chunks packed, and samples of chunks (or rows of tiles) that other rows begin
/// or end. Reused from block to block.
struct PackedRows {
    struct Chunk {
        int first_row = 0;
        int column = 0;  ///< of a tile
        std::size_t bytes = 0;
    };

    std::vector<std::uint8_t> head;  ///< samples that continue a chunk begun before
    int head_rows = 0;
    std::vector<Chunk> chunks;
    std::vector<std::uint8_t> packed;  ///< of the chunks, one after the other
    std::vector<std::uint8_t> tail;    ///< samples that begin a chunk
    int tail_rows = 0;
    std::vector<std::uint8_t> samples;  ///< of the chunk or row of tiles in work
    std::vector<std::uint8_t> tile;     ///< of the tile in work
};

/// The chunks of a part in ZIP or ZIPS, scanlines or tiles of one level, and their table. Rows of a chunk, or of a row
/// of tiles, are gathered until they are complete. Packing is for any thread; appending is
/// in the order of rows. Throws std::runtime_error where the stream does.
class ZipOutput {
  public:
    /// True where the class can write the header's compression.
    [[nodiscard]] static bool can_write(const Imf::Header& header);

    /// `part`: the number of the part where the file has several.
    ZipOutput(Imf::OStream& stream, const Imf::Header& header, std::span<const OutputChannel> channels,
              std::optional<std::uint32_t> part);

    /// Writes room for the table of chunks, where the stream stands.
    void reserve_table();

    /// Rows of each channel, in the order given to the constructor.
    void pack(int first_row, int row_count, std::span<const ChannelRows> channels, ZipEncoder& encoder,
              PackedRows& out) const;

    /// The rows that follow those of the last call.
    void append(const PackedRows& rows);

    /// Writes the table of chunks; every row must have been appended.
    void finish();

    /// libdeflate's level for the header's.
    [[nodiscard]] int level() const { return m_level; }

    /// Of tiles their height.
    [[nodiscard]] int lines_per_chunk() const { return m_lines; }

  private:
    /// One past the last row of the chunk that holds `row`.
    [[nodiscard]] int chunk_end(int row) const;
    void gather(int row, std::span<const ChannelRows> channels, int first_row, std::uint8_t* out) const;
    /// The lines of a chunk or a row of tiles as packed chunks, added to `chunks` and `packed`.
    void encode(int first_row, std::span<const std::uint8_t> lines, ZipEncoder& encoder,
                std::vector<std::uint8_t>& tile, std::vector<PackedRows::Chunk>& chunks,
                std::vector<std::uint8_t>& packed) const;
    void gather_tile(int column, std::span<const std::uint8_t> lines, std::vector<std::uint8_t>& tile) const;
    void write_chunks(std::span<const PackedRows::Chunk> chunks, std::span<const std::uint8_t> packed);

    Imf::OStream& m_stream;
    std::optional<std::uint32_t> m_part;
    std::vector<std::size_t> m_order;  ///< channels as the file has them, sorted by name
    std::vector<std::size_t> m_sample_bytes;
    int m_first_row;
    int m_end_row;
    int m_lines;
    int m_level;
    std::size_t m_width;
    std::size_t m_tile_width = 0;  ///< 0: scanlines
    int m_columns = 1;
    std::size_t m_line_bytes = 0;
    std::uint64_t m_table_position = 0;
    std::vector<std::uint64_t> m_table;
    std::vector<std::uint8_t> m_open;  ///< samples of a chunk or row of tiles that is not complete
    int m_open_rows = 0;
    int m_next_row;
    ZipEncoder m_encoder;
};

}  // namespace osio::exr
