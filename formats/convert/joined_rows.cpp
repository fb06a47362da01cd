// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/joined_rows.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

namespace osio::convert {

namespace {

/// Any rows of a source, plane by plane. The block that was read last is kept: the next rows often begin in it.
class RowGatherer {
  public:
    RowGatherer(const BlockSource& source, std::unique_ptr<BlockReader> reader)
        : m_source(source), m_reader(std::move(reader)) {}

    [[nodiscard]] Result<std::span<const BandView>> gather(RowRange rows) {
        const auto width = static_cast<std::size_t>(m_source.width());
        const auto samples = static_cast<std::size_t>(rows.last - rows.first + 1) * width;
        for (int row = rows.first; row <= rows.last;) {
            OSIO_CHECK_OK(load(m_source.block_of_row(row)));
            const PlanarBlock some = m_block->among({row, rows.last});
            const auto before = static_cast<std::size_t>(some.first_row - rows.first) * width;
            m_planes.resize(some.planes.size());
            some.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
                for (std::size_t p = 0; p < planes.size(); ++p)
                    copy(planes[p], count, samples, before + first, m_planes[p]);
            });
            row = some.first_row + some.row_count;
        }
        m_views.clear();
        for (std::size_t p = 0; p < m_planes.size(); ++p) {
            const SampleType type = m_block->planes[p].type;
            m_views.push_back({m_planes[p].empty() ? nullptr : m_planes[p].data(), type,
                               static_cast<std::ptrdiff_t>(sample_bytes(type))});
        }
        return std::span<const BandView>(m_views);
    }

  private:
    [[nodiscard]] Result<void> load(std::size_t block) {
        if (m_index == block)
            return {};
        m_index.reset();
        OSIO_TRY(m_block, m_reader->read(block));
        m_index = block;
        return {};
    }

    static void copy(const BandView& from, std::size_t count, std::size_t samples, std::size_t at,
                     std::vector<std::byte>& to) {
        if (from.data == nullptr)  // a plane that nobody reads
            return;
        const std::size_t bytes = sample_bytes(from.type);
        to.resize(samples * bytes);
        if (from.contiguous()) {
            std::memcpy(to.data() + at * bytes, from.data, count * bytes);
            return;
        }
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(to.data() + (at + i) * bytes, from.advanced(i).data, bytes);
    }

    const BlockSource& m_source;
    std::unique_ptr<BlockReader> m_reader;
    std::optional<std::size_t> m_index;
    std::optional<PlanarBlock> m_block;
    std::vector<std::vector<std::byte>> m_planes;
    std::vector<BandView> m_views;
};

class JoinedReader final : public BlockReader {
  public:
    JoinedReader(const BlockSource& grid, std::vector<RowGatherer> gatherers,
                 const std::vector<JoinedPlane>& planes)
        : m_grid(grid), m_gatherers(std::move(gatherers)), m_planes(planes) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const RowRange rows = m_grid.rows_of_block(block);
        std::vector<std::span<const BandView>> views;
        for (RowGatherer& gatherer : m_gatherers) {
            OSIO_TRY(const auto some, gatherer.gather(rows));
            views.push_back(some);
        }
        PlanarBlock out{rows.first, rows.last - rows.first + 1, m_grid.width(), {}, 0};
        for (const JoinedPlane& plane : m_planes)
            out.planes.push_back(views[plane.source][plane.plane]);
        return out;
    }

  private:
    const BlockSource& m_grid;
    std::vector<RowGatherer> m_gatherers;
    const std::vector<JoinedPlane>& m_planes;
};

class JoinedSource final : public BlockSource {
  public:
    JoinedSource(std::vector<std::unique_ptr<BlockSource>> sources, std::vector<JoinedPlane> planes)
        : m_sources(std::move(sources)), m_planes(std::move(planes)) {}

    [[nodiscard]] int width() const override { return grid().width(); }

    [[nodiscard]] std::size_t block_count() const override { return grid().block_count(); }

    [[nodiscard]] std::size_t block_of_row(int row) const override { return grid().block_of_row(row); }

    [[nodiscard]] RowRange rows_of_block(std::size_t block) const override {
        return grid().rows_of_block(block);
    }

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        std::vector<RowGatherer> gatherers;
        for (const auto& source : m_sources) {
            OSIO_TRY(auto reader, source->start_reader());
            gatherers.emplace_back(*source, std::move(reader));
        }
        return std::make_unique<JoinedReader>(grid(), std::move(gatherers), m_planes);
    }

  private:
    [[nodiscard]] const BlockSource& grid() const { return *m_sources.front(); }

    std::vector<std::unique_ptr<BlockSource>> m_sources;
    std::vector<JoinedPlane> m_planes;
};

class RegroupedReader final : public BlockReader {
  public:
    RegroupedReader(const BlockSource& grid, RowGatherer gatherer)
        : m_grid(grid), m_gatherer(std::move(gatherer)) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const RowRange rows = m_grid.rows_of_block(block);
        OSIO_TRY(const auto views, m_gatherer.gather(rows));
        return PlanarBlock{
            rows.first, rows.last - rows.first + 1, m_grid.width(), {views.begin(), views.end()}, 0};
    }

  private:
    const BlockSource& m_grid;
    RowGatherer m_gatherer;
};

class RegroupedSource final : public BlockSource {
  public:
    RegroupedSource(std::unique_ptr<BlockSource> source, RowRange window, int rows_per_block)
        : m_source(std::move(source)), m_window(window), m_rows(rows_per_block) {}

    [[nodiscard]] int width() const override { return m_source->width(); }

    [[nodiscard]] std::size_t block_count() const override { return block_of_row(m_window.last) + 1; }

    [[nodiscard]] std::size_t block_of_row(int row) const override {
        return static_cast<std::size_t>((std::int64_t{row} - m_window.first) / m_rows);
    }

    [[nodiscard]] RowRange rows_of_block(std::size_t block) const override {
        const std::int64_t first = m_window.first + static_cast<std::int64_t>(block) * m_rows;
        return {static_cast<int>(first),
                static_cast<int>(std::min<std::int64_t>(m_window.last, first + m_rows - 1))};
    }

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, m_source->start_reader());
        return std::make_unique<RegroupedReader>(*this, RowGatherer(*m_source, std::move(reader)));
    }

  private:
    std::unique_ptr<BlockSource> m_source;
    RowRange m_window;
    int m_rows;
};

}  // namespace

std::unique_ptr<BlockSource> regroup(std::unique_ptr<BlockSource> source, RowRange window,
                                     int rows_per_block) {
    return std::make_unique<RegroupedSource>(std::move(source), window, rows_per_block);
}

std::unique_ptr<BlockSource> join_sources(std::vector<std::unique_ptr<BlockSource>> sources,
                                          std::vector<JoinedPlane> planes) {
    return std::make_unique<JoinedSource>(std::move(sources), std::move(planes));
}

}  // namespace osio::convert
