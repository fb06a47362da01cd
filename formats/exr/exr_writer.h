// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/exr/output_rows.h>
#include <formats/files/replacement_file.h>

#include <osio/base/result.h>
#include <osio/collapse/collapse_stream.h>

#include <OpenEXR/ImfHeader.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace osio::exr {

/// How many threads OpenEXR compresses with in this process, where it is OpenEXR that compresses. For
/// programs; in a plugin the host says.
void set_compression_threads(unsigned count);

/// A flat part of a file: scanlines, or tiles of one level where the header has a tile description.
struct OutputPart {
    Imf::Header header;  ///< windows, compression, tiles and attributes; of several parts also a name
    std::vector<OutputChannel> channels;
};

/// Writes an OpenEXR file of one or several flat parts, each part's rows from top to bottom, into a temporary beside
/// the target that takes the target's place in finish(). Until then, and where anything fails, the old file stays
/// and the temporary goes away. ZIP and ZIPS are packed by libdeflate, at the header's level, on the
/// caller's threads; the others by OpenEXR.
class ExrWriter {
  public:
    /// `header` gives windows, compression and attributes; its channels are replaced.
    [[nodiscard]] static Result<std::unique_ptr<ExrWriter>>
    create(const std::string& path, Imf::Header header, std::span<const OutputChannel> channels);

    /// The same for several parts.
    [[nodiscard]] static Result<std::unique_ptr<ExrWriter>> create(const std::string& path,
                                                                   std::vector<OutputPart> parts);

    ExrWriter(const ExrWriter&) = delete;
    ExrWriter& operator=(const ExrWriter&) = delete;
    ~ExrWriter();

    /// Packs rows ahead of their turn. One for each worker, and outlived by the writer.
    class Packer {
      public:
        virtual ~Packer() = default;

        /// Any rows, while other packers work on theirs.
        [[nodiscard]] virtual Result<void> pack(int first_row, int row_count,
                                                std::span<const ChannelRows> channels) = 0;

        /// Writes what was packed: one call at a time, in the order of rows.
        [[nodiscard]] virtual Result<void> write() = 0;
    };

    [[nodiscard]] std::unique_ptr<Packer> start_packer(std::size_t part = 0);

    /// Of tiles that are packed by packers: their height, which is how many rows a packer packs alone; else 0.
    [[nodiscard]] int rows_together(std::size_t part = 0) const;

    /// The next rows of a part; one ChannelRows for each channel, in the order given to create(). With a runner
    /// the work is spread over its workers.
    [[nodiscard]] Result<void> write_rows(int row_count, std::span<const ChannelRows> channels,
                                          Runner* runner = nullptr, std::size_t part = 0);

    /// The text of an attribute that reserve_text() made in a part's header; finish() writes it.
    void set_text(std::size_t part, std::string name, std::string text);

    /// Completes the file, gives it its checksum and puts it in its place. Fails where rows are missing
    /// or where the system could not store every byte.
    [[nodiscard]] Result<void> finish(files::Durability durability = files::Durability::Handed);

  private:
    class ZipPacker;
    class PlainPacker;
    struct State;
    explicit ExrWriter(std::unique_ptr<State> state);

    std::unique_ptr<State> m_state;
};

/// Takes rows of floats into a part of half or float channels. What exceeds +-65504 becomes
/// +-65504 in half, and is counted; NaN stays NaN.
class ExrSink final : public RowSink {
  public:
    /// `width`: of the part's data window, in pixels. The writer is finished when all its parts are.
    ExrSink(std::shared_ptr<ExrWriter> writer, SampleType type, int width, std::size_t part = 0);

    [[nodiscard]] Result<void> write_rows(int first_row, int row_count,
                                          std::span<const float* const> planes) override;

    /// Converts and packs in the workers.
    [[nodiscard]] std::unique_ptr<RowWorker> start_worker() override;

    [[nodiscard]] Result<void> finish(files::Durability durability = files::Durability::Handed) {
        return m_writer->finish(durability);
    }

    /// ExrWriter::set_text() of its part.
    void set_text(std::string name, std::string text) {
        m_writer->set_text(m_part, std::move(name), std::move(text));
    }

    /// Samples that did not fit a half.
    [[nodiscard]] std::uint64_t clamped_count() const { return m_clamped; }

  private:
    class Worker;

    std::shared_ptr<ExrWriter> m_writer;
    std::size_t m_part;
    SampleType m_type;
    std::size_t m_width;
    std::uint64_t m_clamped = 0;
};

}  // namespace osio::exr
