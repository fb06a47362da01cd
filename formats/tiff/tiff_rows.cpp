// SPDX-License-Identifier: Apache-2.0
#include <formats/image/even_rows.h>
#include <formats/image/limits.h>
#include <formats/tiff/page_rows.h>
#include <formats/tiff/tiff_rows.h>

#include <algorithm>
#include <map>

namespace osio::tiff {

namespace {

/// What readers of one source share.
struct Job {
    std::shared_ptr<const TiffFile> file;
    std::size_t part = 0;
    image::PlaneChannels planes;
    int width = 0, height = 0, rows_per_block = 1;
};

class RowReader final : public BlockReader {
  public:
    RowReader(const Job& job, std::unique_ptr<Handle> handle) : m_job(job), m_rows(std::move(handle)) {
        const std::size_t pixels =
            static_cast<std::size_t>(job.width) * static_cast<std::size_t>(job.rows_per_block);
        for (const auto& channel : job.planes)
            m_planes.emplace_back(channel ? pixels : 0);
        for (std::size_t plane = 0; plane < job.planes.size(); ++plane)
            if (job.planes[plane]) {
                const Plane& stored = job.file->planes(job.part)[*job.planes[plane]];
                m_by_page[stored.page].push_back({stored.sample, &stored.scaling, m_planes[plane].data()});
            }
    }

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const auto first = static_cast<std::int64_t>(block) * m_job.rows_per_block;
        const auto count = std::min<std::int64_t>(m_job.rows_per_block, m_job.height - first);
        for (const auto& [page, wanted] : m_by_page)
            if (auto result = m_rows.read(m_job.file->pages()[page], static_cast<std::uint32_t>(first),
                                          static_cast<std::uint32_t>(count), wanted);
                !result)
                return fail_in(m_job.file->path(), result.error());
        PlanarBlock out{static_cast<int>(first), static_cast<int>(count), m_job.width, {}};
        for (const auto& plane : m_planes)
            out.planes.push_back({reinterpret_cast<const std::byte*>(plane.empty() ? nullptr : plane.data()),
                                  SampleType::Float, sizeof(float)});
        return out;
    }

  private:
    const Job& m_job;
    PageRows m_rows;
    std::vector<std::vector<float>> m_planes;
    std::map<std::size_t, std::vector<WantedSample>> m_by_page;
};

class RowSource final : public image::EvenRows {
  public:
    explicit RowSource(Job job)
        : EvenRows(job.width, job.height, job.rows_per_block), m_job(std::move(job)) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        auto handle = Handle::open(m_job.file->data());
        if (!handle)
            return fail_in(m_job.file->path(), handle.error());
        return std::make_unique<RowReader>(m_job, std::move(*handle));
    }

  private:
    Job m_job;
};

}  // namespace

Result<std::unique_ptr<BlockSource>> make_row_source(std::shared_ptr<const TiffFile> file, std::size_t part,
                                                     image::PlaneChannels planes, image::Grain grain) {
    const image::Part& header = file->parts()[part];
    Job job{
        std::move(file), part, std::move(planes), header.data_window.width(), header.data_window.height(), 1};
    std::uint64_t unit = 1, block_bytes = 0, wanted = 0;
    for (const auto& channel : job.planes)
        if (channel) {
            ++wanted;
            const Page& page = job.file->pages()[job.file->planes(part)[*channel].page];
            if (!page.plain)
                unit = std::max<std::uint64_t>(unit, std::min(page.block_height, page.height));
            block_bytes = std::max(block_bytes, page.block_bytes(page.plain ? 1 : page.block_height));
        }
    const std::uint64_t row_bytes =
        static_cast<std::uint64_t>(job.width) * std::max<std::uint64_t>(wanted, 1) * sizeof(float);
    if (row_bytes > image::kMostBlockBytes / unit || block_bytes > image::kMostBlockBytes)
        return fail(ErrorCode::Unsupported,
                    "its strips or tiles have " + std::to_string(unit) + " rows, which need more than " +
                        std::to_string(image::kMostBlockBytes) + " bytes at once; write it with smaller ones",
                    job.file->path());
    const std::uint64_t units =
        grain == image::Grain::Chunk
            ? 1
            : std::max<std::uint64_t>(1, image::EvenRows::kBlockBytes / row_bytes / unit);
    job.rows_per_block = static_cast<int>(std::min(units * unit, static_cast<std::uint64_t>(job.height)));
    return std::make_unique<RowSource>(std::move(job));
}

}  // namespace osio::tiff
