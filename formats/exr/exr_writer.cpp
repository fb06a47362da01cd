// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/checksum.h>
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/exr_file.h>
#include <formats/exr/exr_writer.h>
#include <formats/files/checked_file.h>
#include <formats/files/replacement_file.h>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>

#include <cmath>
#include <exception>
#include <optional>
#include <stdexcept>

namespace osio::exr {

void set_compression_threads(unsigned count) {
    Imf::setGlobalThreadCount(static_cast<int>(count));
}

namespace {

/// The largest finite half.
constexpr float kHalfMax = 65504.0F;

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
          stream(file.path()), output(std::in_place, stream, header, Imf::globalThreadCount()),
          first_row(header.dataWindow().min.y), min_x(header.dataWindow().min.x),
          width(header.dataWindow().max.x - min_x + 1), rows_left(header.dataWindow().max.y - first_row + 1) {
    }

    files::ReplacementFile file;
    std::vector<OutputChannel> channels;
    CheckedStream stream;
    std::optional<Imf::OutputFile> output;
    int first_row;
    int min_x;
    int width;
    int rows_left;
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

Result<void> ExrWriter::write_rows(int row_count, std::span<const ChannelRows> channels) {
    State& state = *m_state;
    try {
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto& rows = channels[c];
            buffer.insert(state.channels[c].name,
                          Imf::Slice::Make(pixel_type(state.channels[c].type), rows.data,
                                           Imath::V2i(state.min_x, state.first_row), state.width, row_count,
                                           static_cast<std::size_t>(rows.pixel_stride_bytes),
                                           static_cast<std::size_t>(rows.row_stride_bytes)));
        }
        state.output->setFrameBuffer(buffer);
        state.output->writePixels(row_count);
    } catch (const std::exception& error) {
        return fail(ErrorCode::Io, std::string("cannot be written: ") + error.what(), state.file.target());
    }
    state.first_row += row_count;
    state.rows_left -= row_count;
    return {};
}

Result<void> ExrWriter::finish(files::Durability durability) {
    State& state = *m_state;
    if (state.rows_left != 0)
        return fail(ErrorCode::Io, std::to_string(state.rows_left) + " rows were never written",
                    state.file.target());
    state.output.reset();  // writes the offset table
    if (state.stream.file().close() != 0)
        return fail(ErrorCode::Io, "cannot be written: " + state.stream.file().failure(),
                    state.file.target());
    if (auto result = write_checksum(state.file.path()); !result)
        return fail_in(state.file.target(), std::move(result).error());
    return state.file.commit(durability);
}

ExrSink::ExrSink(std::unique_ptr<ExrWriter> writer, SampleType type, int width)
    : m_writer(std::move(writer)), m_type(type), m_width(static_cast<std::size_t>(width)) {}

Result<void> ExrSink::write_rows(int, int row_count, std::span<const float* const> planes) {
    const std::size_t samples = static_cast<std::size_t>(row_count) * m_width;
    const auto bytes = static_cast<std::ptrdiff_t>(sample_bytes(m_type));
    std::vector<ChannelRows> channels;
    if (m_type == SampleType::Half)
        m_halves.resize(samples * planes.size());
    for (std::size_t c = 0; c < planes.size(); ++c) {
        const void* data = planes[c];
        if (m_type == SampleType::Half) {
            std::uint16_t* const halves = m_halves.data() + c * samples;
            for (std::size_t i = 0; i < samples; ++i) {
                const float value = planes[c][i];
                const bool clamped = std::abs(value) > kHalfMax;
                m_clamped += clamped;
                halves[i] = Imath::half(clamped ? std::copysign(kHalfMax, value) : value).bits();
            }
            data = halves;
        }
        channels.push_back(
            {static_cast<const std::byte*>(data), bytes, bytes * static_cast<std::ptrdiff_t>(m_width)});
    }
    return m_writer->write_rows(row_count, channels);
}

}  // namespace osio::exr
