// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/exr/zip_output.h>
#include <formats/files/checked_file.h>
#include <formats/files/replacement_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <atomic>
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
    State(files::ReplacementFile replacement, const Imf::Header& header,
          std::span<const OutputChannel> output_channels)
        : file(std::move(replacement)), channels(output_channels.begin(), output_channels.end()),
          stream(file.path()), next_row(header.dataWindow().min.y), min_x(header.dataWindow().min.x),
          width(header.dataWindow().max.x - min_x + 1), rows_left(header.dataWindow().max.y - next_row + 1) {
        if (ZipOutput::can_write(header))
            zip.emplace(stream, header, channels);
        else
            output.emplace(stream, header, Imf::globalThreadCount());
    }

    /// Runs what writes, and turns what OpenEXR and the stream throw into an error.
    template <class Write>
    Result<void> guarded(int row_count, Write write) {
        try {
            write();
        } catch (const std::exception& error) {
            return fail(ErrorCode::Io, std::string("cannot be written: ") + error.what(), file.target());
        }
        next_row += row_count;
        rows_left -= row_count;
        return {};
    }

    files::ReplacementFile file;
    std::vector<OutputChannel> channels;
    CheckedStream stream;
    std::optional<ZipOutput> zip;  ///< this or the next
    std::optional<Imf::OutputFile> output;
    int next_row;
    int min_x;
    int width;
    int rows_left;
};

/// Packs chunks in the worker.
class ExrWriter::ZipPacker final : public Packer {
  public:
    explicit ZipPacker(State& state) : m_state(state), m_encoder(state.zip->level()) {}

    [[nodiscard]] Result<void> pack(int first_row, int row_count,
                                    std::span<const ChannelRows> channels) override {
        m_row_count = row_count;
        m_state.zip->pack(first_row, row_count, channels, m_encoder, m_rows);
        return {};
    }

    [[nodiscard]] Result<void> write() override {
        return m_state.guarded(m_row_count, [&] { m_state.zip->append(m_rows); });
    }

  private:
    State& m_state;
    ZipEncoder m_encoder;
    PackedRows m_rows;
    int m_row_count = 0;
};

/// Leaves the packing to OpenEXR, when it is the rows' turn.
class ExrWriter::PlainPacker final : public Packer {
  public:
    explicit PlainPacker(State& state) : m_state(state) {}

    [[nodiscard]] Result<void> pack(int, int row_count, std::span<const ChannelRows> channels) override {
        m_row_count = row_count;
        m_channels.assign(channels.begin(), channels.end());
        return {};
    }

    [[nodiscard]] Result<void> write() override {
        return m_state.guarded(m_row_count, [&] {
            Imf::FrameBuffer buffer;
            for (std::size_t c = 0; c < m_channels.size(); ++c) {
                const auto& rows = m_channels[c];
                buffer.insert(m_state.channels[c].name,
                              Imf::Slice::Make(pixel_type(m_state.channels[c].type), rows.data,
                                               Imath::V2i(m_state.min_x, m_state.next_row), m_state.width,
                                               m_row_count, static_cast<std::size_t>(rows.pixel_stride_bytes),
                                               static_cast<std::size_t>(rows.row_stride_bytes)));
            }
            m_state.output->setFrameBuffer(buffer);
            m_state.output->writePixels(m_row_count);
        });
    }

  private:
    State& m_state;
    std::vector<ChannelRows> m_channels;
    int m_row_count = 0;
};

ExrWriter::ExrWriter(std::unique_ptr<State> state) : m_state(std::move(state)) {}

ExrWriter::~ExrWriter() = default;

Result<std::unique_ptr<ExrWriter>> ExrWriter::create(const std::string& path, Imf::Header header,
                                                     std::span<const OutputChannel> channels) {
    OSIO_TRY(files::ReplacementFile file, files::ReplacementFile::create(path));
    try {
        header.channels() = Imf::ChannelList();
        for (const OutputChannel& channel : channels)
            header.channels().insert(channel.name, Imf::Channel(pixel_type(channel.type)));
        header.lineOrder() = Imf::INCREASING_Y;
        reserve_checksum(scanline_chunks(header), header);
        return std::unique_ptr<ExrWriter>(
            new ExrWriter(std::make_unique<State>(std::move(file), header, channels)));
    } catch (const std::exception& error) {
        return fail(ErrorCode::Io, std::string("cannot be written: ") + error.what(), path);
    }
}

std::unique_ptr<ExrWriter::Packer> ExrWriter::start_packer() {
    if (m_state->zip)
        return std::make_unique<ZipPacker>(*m_state);
    return std::make_unique<PlainPacker>(*m_state);
}

Result<void> ExrWriter::write_rows(int row_count, std::span<const ChannelRows> channels, Runner* runner) {
    const int lines = m_state->zip ? m_state->zip->lines_per_chunk() : row_count;
    const int first_row = m_state->next_row, end_row = first_row + row_count;
    const int rows_per_piece = std::max(lines, kFewestRows / lines * lines);
    const bool spread = runner != nullptr && m_state->zip && row_count > rows_per_piece;
    const unsigned workers = spread ? runner->worker_count() : 1;
    std::vector<std::unique_ptr<Packer>> packers;
    for (unsigned worker = 0; worker < workers; ++worker)
        packers.push_back(start_packer());
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

Result<void> ExrWriter::finish(files::Durability durability) {
    State& state = *m_state;
    if (state.rows_left != 0)
        return fail(ErrorCode::Io, std::to_string(state.rows_left) + " rows were never written",
                    state.file.target());
    if (state.zip)
        OSIO_CHECK_OK(state.guarded(0, [&] { state.zip->finish(); }));
    state.output.reset();  // writes the offset table
    if (state.stream.file().close() != 0)
        return fail(ErrorCode::Io, "cannot be written: " + state.stream.file().failure(),
                    state.file.target());
    if (auto result = write_checksum(state.file.path()); !result)
        return fail_in(state.file.target(), std::move(result).error());
    return state.file.commit(durability);
}

}  // namespace osio::exr
