// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/exr/header_output.h>
#include <formats/exr/reserved_text.h>
#include <formats/exr/tile_rows.h>
#include <formats/exr/zip_output.h>
#include <formats/files/checked_file.h>
#include <formats/files/replacement_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <optional>
#include <stdexcept>

namespace osio::exr {

void set_compression_threads(unsigned count) {
    Imf::setGlobalThreadCount(static_cast<int>(count));
}

namespace {

/// Fewer rows are not worth handing to a worker.
constexpr int kFewestRows = 16;

/// OpenEXR's view of a checked file: its OutputFile writes the offset table when it is destroyed and
/// swallows what goes wrong there.
class CheckedStream final : public Imf::OStream {
  public:
    explicit CheckedStream(const std::string& path) : Imf::OStream(path.c_str()), m_file(path) {}

    void write(const char bytes[], int count) override {
        if (!m_file.write(bytes, static_cast<std::size_t>(count)))
            throw std::runtime_error(m_file.failure());
    }

    std::uint64_t tellp() override { return m_file.position(); }

    void seekp(std::uint64_t position) override { m_file.seek(position); }

    [[nodiscard]] files::CheckedFile& file() { return m_file; }

  private:
    files::CheckedFile m_file;
};

}  // namespace

struct ExrWriter::State {
    /// What is known of a part while it is written.
    struct Part {
        explicit Part(const OutputPart& part)
            : channels(part.channels), next_row(part.header.dataWindow().min.y),
              min_x(part.header.dataWindow().min.x), width(part.header.dataWindow().max.x - min_x + 1),
              rows_left(part.header.dataWindow().max.y - next_row + 1) {
            if (part.header.hasTileDescription())
                tiles.emplace(part.header, part.channels);
        }

        std::vector<OutputChannel> channels;
        std::optional<ZipOutput> zip;   ///< nothing where OpenEXR writes the chunks
        std::optional<TileRows> tiles;  ///< of a tiled part, where it does
        int next_row;
        int min_x;
        int width;
        int rows_left;
    };

    State(files::ReplacementFile replacement, const std::vector<OutputPart>& output_parts)
        : file(std::move(replacement)), stream(file.path()) {
        std::vector<Imf::Header> headers;
        for (const OutputPart& part : output_parts) {
            headers.push_back(part.header);
            parts.emplace_back(part);
        }
        if (std::all_of(headers.begin(), headers.end(), ZipOutput::can_write))
            start_zip(output_parts, headers);
        else if (headers.size() == 1 && headers.front().hasTileDescription())
            tiled_output.emplace(stream, headers.front(), Imf::globalThreadCount());
        else if (headers.size() == 1)
            output.emplace(stream, headers.front(), Imf::globalThreadCount());
        else
            outputs.emplace(stream, headers.data(), static_cast<int>(headers.size()), false,
                            Imf::globalThreadCount());
    }

    void start_zip(const std::vector<OutputPart>& output_parts, const std::vector<Imf::Header>& headers) {
        for (std::size_t i = 0; i < parts.size(); ++i)
            parts[i].zip.emplace(stream, headers[i], output_parts[i].channels,
                                 parts.size() > 1 ? std::optional(static_cast<std::uint32_t>(i))
                                                  : std::nullopt);
        write_headers(stream, headers);
        for (Part& part : parts)
            part.zip->reserve_table();
    }

    /// Runs what writes, and turns what OpenEXR and the stream throw into an error.
    template <class Write>
    Result<void> guarded(Write write) {
        try {
            write();
        } catch (const std::exception& error) {
            return fail(ErrorCode::Io, std::string("cannot be written: ") + error.what(), file.target());
        }
        return {};
    }

    /// The same for rows of a part.
    template <class Write>
    Result<void> guarded(Part& part, int row_count, Write write) {
        OSIO_CHECK_OK(guarded(write));
        part.next_row += row_count;
        part.rows_left -= row_count;
        return {};
    }

    /// Rows at a part's turn, packed by OpenEXR.
    void write_rows(std::size_t index, std::span<const ChannelRows> rows, int row_count) {
        Part& part = parts[index];
        if (part.tiles) {
            part.tiles->add(rows, row_count, [&](int tile_row, const Imf::FrameBuffer& pixels) {
                write_tiles(index, tile_row, pixels);
            });
            return;
        }
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < rows.size(); ++c)
            buffer.insert(part.channels[c].name,
                          Imf::Slice::Make(pixel_type(part.channels[c].type), rows[c].data,
                                           Imath::V2i(part.min_x, part.next_row), part.width, row_count,
                                           static_cast<std::size_t>(rows[c].pixel_stride_bytes),
                                           static_cast<std::size_t>(rows[c].row_stride_bytes)));
        if (output) {
            output->setFrameBuffer(buffer);
            output->writePixels(row_count);
            return;
        }
        Imf::OutputPart several(*outputs, static_cast<int>(index));
        several.setFrameBuffer(buffer);
        several.writePixels(row_count);
    }

    void write_tiles(std::size_t index, int tile_row, const Imf::FrameBuffer& pixels) {
        const auto write = [&](auto& tiled) {
            tiled.setFrameBuffer(pixels);
            tiled.writeTiles(0, tiled.numXTiles(0) - 1, tile_row, tile_row, 0);
        };
        if (tiled_output)
            return write(*tiled_output);
        Imf::TiledOutputPart several(*outputs, static_cast<int>(index));
        write(several);
    }

    files::ReplacementFile file;
    CheckedStream stream;
    std::deque<Part> parts;
    std::optional<Imf::OutputFile> output;             ///< of one part that is not ours to pack
    std::optional<Imf::TiledOutputFile> tiled_output;  ///< the same of tiles
    std::optional<Imf::MultiPartOutputFile> outputs;   ///< of several

    struct Text {
        std::size_t part;
        std::string name;
        std::string text;
    };

    std::vector<Text> texts;  ///< for their reserved places
};

/// Packs chunks in the worker.
class ExrWriter::ZipPacker final : public Packer {
  public:
    ZipPacker(State& state, std::size_t part)
        : m_state(state), m_part(state.parts[part]), m_encoder(m_part.zip->level()) {}

    [[nodiscard]] Result<void> pack(int first_row, int row_count,
                                    std::span<const ChannelRows> channels) override {
        m_row_count = row_count;
        m_part.zip->pack(first_row, row_count, channels, m_encoder, m_rows);
        return {};
    }

    [[nodiscard]] Result<void> write() override {
        return m_state.guarded(m_part, m_row_count, [&] { m_part.zip->append(m_rows); });
    }

  private:
    State& m_state;
    State::Part& m_part;
    ZipEncoder m_encoder;
    PackedRows m_rows;
    int m_row_count = 0;
};

/// Leaves the packing to OpenEXR, when it is the rows' turn.
class ExrWriter::PlainPacker final : public Packer {
  public:
    PlainPacker(State& state, std::size_t part) : m_state(state), m_index(part) {}

    [[nodiscard]] Result<void> pack(int, int row_count, std::span<const ChannelRows> channels) override {
        m_row_count = row_count;
        m_channels.assign(channels.begin(), channels.end());
        return {};
    }

    [[nodiscard]] Result<void> write() override {
        return m_state.guarded(m_state.parts[m_index], m_row_count,
                               [&] { m_state.write_rows(m_index, m_channels, m_row_count); });
    }

  private:
    State& m_state;
    std::size_t m_index;
    std::vector<ChannelRows> m_channels;
    int m_row_count = 0;
};

ExrWriter::ExrWriter(std::unique_ptr<State> state) : m_state(std::move(state)) {}

ExrWriter::~ExrWriter() = default;

Result<std::unique_ptr<ExrWriter>> ExrWriter::create(const std::string& path, Imf::Header header,
                                                     std::span<const OutputChannel> channels) {
    return create(path, {OutputPart{std::move(header), {channels.begin(), channels.end()}}});
}

Result<std::unique_ptr<ExrWriter>> ExrWriter::create(const std::string& path, std::vector<OutputPart> parts) {
    OSIO_TRY(files::ReplacementFile file, files::ReplacementFile::create(path));
    try {
        for (OutputPart& part : parts) {
            Imf::Header& header = part.header;
            header.channels() = Imf::ChannelList();
            for (const OutputChannel& channel : part.channels)
                header.channels().insert(channel.name, Imf::Channel(pixel_type(channel.type)));
            header.lineOrder() = Imf::INCREASING_Y;
            const std::size_t chunks = header_chunks(header);
            if (parts.size() > 1) {
                header.setType(header.hasTileDescription() ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
                header.setChunkCount(static_cast<int>(chunks));
            }
            reserve_checksum(chunks, header);
        }
        return std::unique_ptr<ExrWriter>(new ExrWriter(std::make_unique<State>(std::move(file), parts)));
    } catch (const std::exception& error) {
        return fail(ErrorCode::Io, std::string("cannot be written: ") + error.what(), path);
    }
}

std::unique_ptr<ExrWriter::Packer> ExrWriter::start_packer(std::size_t part) {
    if (m_state->parts[part].zip)
        return std::make_unique<ZipPacker>(*m_state, part);
    return std::make_unique<PlainPacker>(*m_state, part);
}

int ExrWriter::rows_together(std::size_t part) const {
    const State::Part& state = m_state->parts[part];
    return state.zip && state.tiles ? state.zip->lines_per_chunk() : 0;
}

Result<void> ExrWriter::write_rows(int row_count, std::span<const ChannelRows> channels, Runner* runner,
                                   std::size_t index) {
    const State::Part& part = m_state->parts[index];
    const int lines = part.zip ? part.zip->lines_per_chunk() : row_count;
    const int first_row = part.next_row, end_row = first_row + row_count;
    const int rows_per_piece = std::max(lines, kFewestRows / lines * lines);
    const bool spread = runner != nullptr && part.zip && row_count > rows_per_piece;
    const unsigned workers = spread ? runner->worker_count() : 1;
    std::vector<std::unique_ptr<Packer>> packers;
    for (unsigned worker = 0; worker < workers; ++worker)
        packers.push_back(start_packer(index));
    const auto pack = [&](unsigned worker, int first, int end) {
        std::vector<ChannelRows> rows(channels.begin(), channels.end());
        for (ChannelRows& channel : rows)
            channel.data += channel.row_stride_bytes * (first - first_row);
        return packers[worker]->pack(first, end - first, rows);
    };
    // A wave: a piece for each worker, then their turns.
    for (int row = first_row; row < end_row;) {
        std::vector<std::pair<int, int>> pieces;
        for (unsigned worker = 0; worker < workers && row < end_row; ++worker) {
            const int end = spread ? std::min(end_row, row + rows_per_piece) : end_row;
            pieces.emplace_back(row, end);
            row = end;
        }
        std::vector<Result<void>> results(pieces.size());
        const auto work = [&](unsigned worker) {
            if (worker < pieces.size())
                results[worker] = pack(worker, pieces[worker].first, pieces[worker].second);
        };
        if (spread)
            runner->run(work);
        else
            work(0);
        for (unsigned worker = 0; worker < pieces.size(); ++worker) {
            OSIO_CHECK_OK(std::move(results[worker]));
            OSIO_CHECK_OK(packers[worker]->write());
        }
    }
    return {};
}

void ExrWriter::set_text(std::size_t part, std::string name, std::string text) {
    m_state->texts.push_back({part, std::move(name), std::move(text)});
}

Result<void> ExrWriter::finish(files::Durability durability) {
    State& state = *m_state;
    for (State::Part& part : state.parts) {
        if (part.rows_left != 0)
            return fail(ErrorCode::Io, std::to_string(part.rows_left) + " rows were never written",
                        state.file.target());
        if (part.zip)
            OSIO_CHECK_OK(state.guarded([&] { part.zip->finish(); }));
    }
    state.output.reset();  // writes the table of chunks
    state.tiled_output.reset();
    state.outputs.reset();  // writes the tables
    if (state.stream.file().close() != 0)
        return fail(ErrorCode::Io, "cannot be written: " + state.stream.file().failure(),
                    state.file.target());
    for (State::Text& text : state.texts)
        if (auto result = write_reserved_text(state.file.path(), text.part, text.name, std::move(text.text));
            !result)
            return fail_in(state.file.target(), std::move(result).error());
    if (auto result = write_checksum(state.file.path()); !result)
        return fail_in(state.file.target(), std::move(result).error());
    return state.file.commit(durability);
}

}  // namespace osio::exr
