// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/block_buffer.h>
#include <formats/exr/block_readers.h>
#include <formats/exr/block_source.h>
#include <formats/exr/chunk_geometry.h>
#include <formats/exr/chunk_guard.h>
#include <formats/exr/limits.h>
#include <formats/exr/line_reader.h>

#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>

namespace osio::exr {

namespace {

/// A block of fewer rows is not worth handing to a worker; chunks of one line are taken together.
constexpr int kFewestRows = 16;

constexpr std::size_t kPlaneAlignment = 64;

std::size_t padded(std::size_t bytes) {
    return (bytes + kPlaneAlignment - 1) / kPlaneAlignment * kPlaneAlignment;
}

using MakeReader = Result<std::unique_ptr<BlockReader>> (*)(const BlockJob&);

/// What decodes a part best: stages of our own, faster than OpenEXR 3.1.5's; else the C++ API, which
/// is 2-4 times faster than its OpenEXRCore at PIZ and has DWA, which that lacks.
MakeReader best_reader(const BlockJob& job) {
    const image::Part& part = job.file->parts()[job.part];
    const bool own = job.file->context() != nullptr && has_own_codec(part) &&
                     std::none_of(part.channels.begin(), part.channels.end(),
                                  [](const image::Channel& channel) { return channel.subsampled; }) &&
                     LineReader::bytes_needed(job) <= image::kMostBlockBytes;
    return own ? make_own_reader : make_imf_reader;
}

class ExrBlockSource final : public BlockSource {
  public:
    explicit ExrBlockSource(BlockJob job) : m_job(std::move(job)) {}

    [[nodiscard]] int width() const override { return m_job.grid.window.width(); }

    [[nodiscard]] std::size_t block_count() const override { return m_job.grid.block_count(); }

    [[nodiscard]] std::size_t block_of_row(int row) const override {
        const auto offset = static_cast<std::size_t>(std::int64_t{row} - m_job.grid.window.min_y);
        return offset / static_cast<std::size_t>(m_job.grid.rows_per_block);
    }

    [[nodiscard]] RowRange rows_of_block(std::size_t block) const override {
        const int first = m_job.grid.first_row(block);
        return {first, first + m_job.grid.row_count(block) - 1};
    }

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, best_reader(m_job)(m_job));
        return guarded(std::move(reader), m_job);
    }

  private:
    BlockJob m_job;
};

}  // namespace

std::size_t BlockGrid::block_count() const {
    const auto rows = static_cast<std::size_t>(rows_per_block);
    return (static_cast<std::size_t>(window.height()) + rows - 1) / rows;
}

int BlockGrid::first_row(std::size_t block) const {
    return static_cast<int>(std::int64_t{window.min_y} + static_cast<std::int64_t>(block) * rows_per_block);
}

int BlockGrid::row_count(std::size_t block) const {
    return static_cast<int>(
        std::min<std::int64_t>(rows_per_block, std::int64_t{window.max_y} - first_row(block) + 1));
}

BlockGrid block_grid(const image::Part& part, Grain grain) {
    if (part.tiled)
        return {part.data_window, static_cast<int>(std::min<std::int64_t>(part.header.tileDescription().ySize,
                                                                          part.data_window.height()))};
    const int lines = lines_of_chunk(part.header.compression());
    return {part.data_window, grain == Grain::Chunk ? lines : lines * std::max(1, kFewestRows / lines)};
}

Result<std::unique_ptr<BlockSource>> make_block_source(std::shared_ptr<const ExrFile> file, std::size_t part,
                                                       PlaneChannels planes, Grain grain) {
    const image::Part& header = file->parts()[part];
    if (header.deep)
        return fail(ErrorCode::Unsupported, "the part is deep (several samples a pixel)", file->path());
    for (const auto channel : planes)
        if (channel && header.channels[*channel].subsampled)
            return fail(ErrorCode::Unsupported,
                        "channel \"" + header.channels[*channel].name + "\" is sub-sampled", file->path());
    const BlockGrid grid = block_grid(header, grain);
    if (grid.rows_per_block <= 0)
        return fail(ErrorCode::Damaged, "tiles of no rows", file->path());
    if (BlockBuffer::bytes_needed(header, planes, grid) > image::kMostBlockBytes)
        return fail(ErrorCode::Damaged,
                    "a row of chunks needs more than " + std::to_string(image::kMostBlockBytes) + " bytes",
                    file->path());
    return std::make_unique<ExrBlockSource>(BlockJob{std::move(file), part, std::move(planes), grid});
}

BlockBuffer::BlockBuffer(const image::Part& part, const PlaneChannels& planes, const BlockGrid& grid)
    : m_width(grid.window.width()), m_memory(bytes_needed(part, planes, grid)) {
    const std::size_t samples =
        static_cast<std::size_t>(grid.window.width()) * static_cast<std::size_t>(grid.rows_per_block);
    void* at = m_memory.data();
    std::size_t space = m_memory.size();
    auto* next = static_cast<std::byte*>(std::align(kPlaneAlignment, 1, at, space));
    for (const auto channel : planes) {
        const SampleType type = channel ? part.channels[*channel].type : SampleType::Float;
        m_types.push_back(type);
        m_planes.push_back(channel ? next : nullptr);
        if (channel)
            next += padded(samples * sample_bytes(type));
    }
}

std::uint64_t BlockBuffer::bytes_needed(const image::Part& part, const PlaneChannels& planes,
                                        const BlockGrid& grid) {
    const std::uint64_t samples =
        static_cast<std::uint64_t>(grid.window.width()) * static_cast<std::uint64_t>(grid.rows_per_block);
    std::uint64_t bytes = kPlaneAlignment;
    for (const auto channel : planes)
        if (channel)
            bytes += padded(samples * sample_bytes(part.channels[*channel].type));
    return bytes;
}

PlanarBlock BlockBuffer::block(int first_row, int row_count) const {
    PlanarBlock out{first_row, row_count, m_width, {}};
    for (std::size_t plane = 0; plane < m_planes.size(); ++plane)
        out.planes.push_back(
            {m_planes[plane], m_types[plane], static_cast<std::ptrdiff_t>(sample_bytes(m_types[plane]))});
    return out;
}

}  // namespace osio::exr
