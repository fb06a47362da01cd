// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/exr_writer.h>

#include <formats/files/replacement_file.h>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>

namespace osio::exr {

namespace {

/// The largest finite half.
constexpr float kHalfMax = 65504.0F;

/// A stream that remembers its first failure. Imf's OutputFile writes its offset table when it is
/// destroyed and swallows what goes wrong there; a full disk would pass unnoticed.
class CheckedStream final : public Imf::OStream {
  public:
    explicit CheckedStream(const std::string& path)
        : Imf::OStream(path.c_str()), m_file(std::fopen(path.c_str(), "wb")) {
        if (m_file == nullptr)
            note();
    }

    CheckedStream(const CheckedStream&) = delete;
    CheckedStream& operator=(const CheckedStream&) = delete;
    ~CheckedStream() override { close(); }

    void write(const char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (m_file == nullptr || std::fwrite(bytes, 1, size, m_file) != size)
            note();
        else
            m_position += size;
        if (m_errno != 0)
            throw std::runtime_error(std::strerror(m_errno));
    }

    std::uint64_t tellp() override { return m_position; }

    void seekp(std::uint64_t position) override {
        if (m_file == nullptr || ::fseeko(m_file, static_cast<off_t>(position), SEEK_SET) != 0)
            note();
        m_position = position;
    }

    /// Hands every byte to the system; 0 or the errno of the first failure since the start.
    int close() {
        if (m_file != nullptr && std::fclose(std::exchange(m_file, nullptr)) != 0)
            note();
        return m_errno;
    }

  private:
    void note() {
        if (m_errno == 0)
            m_errno = errno != 0 ? errno : EIO;
    }

    std::FILE* m_file;
    std::uint64_t m_position = 0;
    int m_errno = 0;
};

Imf::PixelType pixel_type(SampleType type) {
    switch (type) {
    case SampleType::Half: return Imf::HALF;
    case SampleType::Float: return Imf::FLOAT;
    case SampleType::Uint: break;
    }
    return Imf::UINT;
}

}  // namespace

struct ExrWriter::State {
    State(files::ReplacementFile replacement, const Imf::Header& header,
          std::span<const OutputChannel> output_channels)
        : file(std::move(replacement)), channels(output_channels.begin(), output_channels.end()),
          stream(file.path()), output(std::in_place, stream, header, Imf::globalThreadCount()),
          first_row(header.dataWindow().min.y), min_x(header.dataWindow().min.x),
          width(header.dataWindow().max.x - min_x + 1),
          rows_left(header.dataWindow().max.y - first_row + 1) {}

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
                                           Imath::V2i(state.min_x, state.first_row), state.width,
                                           row_count, static_cast<std::size_t>(rows.pixel_stride_bytes),
                                           static_cast<std::size_t>(rows.row_stride_bytes)));
        }
        state.output->setFrameBuffer(buffer);
        state.output->writePixels(row_count);
    } catch (const std::exception& error) {
        return fail(ErrorCode::Io, std::string("cannot be written: ") + error.what(),
                    state.file.target());
    }
    state.first_row += row_count;
    state.rows_left -= row_count;
    return {};
}

Result<void> ExrWriter::finish() {
    State& state = *m_state;
    if (state.rows_left != 0)
        return fail(ErrorCode::Io, std::to_string(state.rows_left) + " rows were never written",
                    state.file.target());
    state.output.reset();  // writes the offset table
    if (const int error = state.stream.close())
        return fail(ErrorCode::Io, std::string("cannot be written: ") + std::strerror(error),
                    state.file.target());
    return state.file.commit();
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
        channels.push_back({static_cast<const std::byte*>(data), bytes,
                            bytes * static_cast<std::ptrdiff_t>(m_width)});
    }
    return m_writer->write_rows(row_count, channels);
}

}  // namespace osio::exr
