// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/chunk_guard.h>
#include <formats/exr/chunk_map.h>

#include <utility>

namespace osio::exr {

namespace {

class GuardedReader final : public BlockReader {
  public:
    GuardedReader(std::unique_ptr<BlockReader> reader, const BlockJob& job)
        : m_reader(std::move(reader)), m_file(job.file), m_part(job.part), m_grid(job.grid) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const int first = m_grid.first_row(block);
        const int last = first + m_grid.row_count(block) - 1;
        const ChunkMap& map = m_file->chunks();
        const auto range = map.chunks_of_rows(m_part, first, last);
        for (std::uint64_t chunk = range.begin; chunk < range.end; ++chunk)
            if (auto result = map.check(m_part, chunk, m_scratch); !result)
                return placed(std::move(result).error(), "chunk " + std::to_string(chunk) + " ", first, last);
        auto out = m_reader->read(block);
        if (!out && out.error().code == ErrorCode::Damaged)
            return placed(std::move(out).error(), {}, first, last);
        return out;
    }

  private:
    [[nodiscard]] tl::unexpected<Error> placed(Error error, const std::string& subject, int first,
                                               int last) const {
        return fail(error.code,
                    "rows " + std::to_string(first) + " to " + std::to_string(last) + ": " + subject +
                        error.what,
                    m_file->path());
    }

    std::unique_ptr<BlockReader> m_reader;
    std::shared_ptr<const ExrFile> m_file;
    std::size_t m_part;
    BlockGrid m_grid;
    std::string m_scratch;
};

}  // namespace

std::unique_ptr<BlockReader> guarded(std::unique_ptr<BlockReader> reader, const BlockJob& job) {
    return std::make_unique<GuardedReader>(std::move(reader), job);
}

}  // namespace osio::exr
