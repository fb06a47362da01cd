// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/files/replacement_file.h>

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>
#include <osio/collapse/collapse_stream.h>

#include <OpenEXR/ImfHeader.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace osio::exr {

/// How many threads OpenEXR compresses with in this process. For programs; in a plugin the host says.
void set_compression_threads(unsigned count);

/// A channel to be written.
struct OutputChannel {
    std::string name;
    SampleType type = SampleType::Float;
};

/// Where a channel's samples lie for some rows; samples have the type of the channel.
struct ChannelRows {
    const std::byte* data = nullptr;  ///< first sample of the first row
    std::ptrdiff_t pixel_stride_bytes = 0;
    std::ptrdiff_t row_stride_bytes = 0;
};

/// Writes a scanline OpenEXR file, rows from top to bottom, into a temporary beside the target that
/// takes the target's place in finish(). Until then, and where anything fails, the old file stays
/// and the temporary goes away.
class ExrWriter {
  public:
    /// `header` gives windows, compression and attributes; its channels are replaced.
    [[nodiscard]] static Result<std::unique_ptr<ExrWriter>>
    create(const std::string& path, Imf::Header header, std::span<const OutputChannel> channels);

    ExrWriter(const ExrWriter&) = delete;
    ExrWriter& operator=(const ExrWriter&) = delete;
    ~ExrWriter();

    /// The next rows; one ChannelRows for each channel, in the order given to create().
    [[nodiscard]] Result<void> write_rows(int row_count, std::span<const ChannelRows> channels);

    /// Completes the file, gives it its checksum and puts it in its place. Fails where rows are missing
    /// or where the system could not store every byte.
    [[nodiscard]] Result<void> finish(files::Durability durability = files::Durability::Handed);

  private:
    struct State;
    explicit ExrWriter(std::unique_ptr<State> state);

    std::unique_ptr<State> m_state;
};

/// Takes rows of floats into an OpenEXR file of half or float channels. What exceeds +-65504 becomes
/// +-65504 in half, and is counted; NaN stays NaN.
class ExrSink final : public RowSink {
  public:
    ExrSink(std::unique_ptr<ExrWriter> writer, SampleType type, int width);

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override;

    [[nodiscard]] Result<void> finish(files::Durability durability = files::Durability::Handed) {
        return m_writer->finish(durability);
    }

    /// Samples that did not fit a half.
    [[nodiscard]] std::uint64_t clamped_count() const { return m_clamped; }

  private:
    std::unique_ptr<ExrWriter> m_writer;
    SampleType m_type;
    std::size_t m_width;
    std::vector<std::uint16_t> m_halves;
    std::uint64_t m_clamped = 0;
};

}  // namespace osio::exr
