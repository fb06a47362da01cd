// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/output_header.h>
#include <formats/exr/soundness.h>
#include <formats/image/colour_attributes.h>

#include <osio/base/text.h>

#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

namespace osio::exr {

namespace {

/// What the workers of one examination share.
class Examination {
  public:
    Examination(const BlockSource& source, RowRange rows, const Progress& progress)
        : m_source(source), m_rows(rows), m_progress(progress), m_first(source.block_of_row(rows.first)),
          m_end(source.block_of_row(rows.last) + 1), m_next(m_first) {}

    Result<void> work() {
        auto reader = m_source.start_reader();
        if (!reader && reader.error().code != ErrorCode::Damaged)
            return tl::unexpected(std::move(reader).error());
        for (std::size_t block = m_next++; block < m_end && !m_stopped; block = m_next++) {
            auto failure = reader ? failure_of((*reader)->read(block)) : std::optional(reader.error());
            if (failure && failure->code != ErrorCode::Damaged)
                return tl::unexpected(std::move(*failure));
            OSIO_CHECK_OK(note(block, failure));
        }
        return {};
    }

    void stop(Error error) {
        const std::lock_guard lock(m_mutex);
        m_stopped = true;
        if (!m_error)
            m_error = std::move(error);
    }

    Result<std::vector<BadRows>> result() {
        if (m_error)
            return tl::unexpected(std::move(*m_error));
        std::sort(m_bad.begin(), m_bad.end(),
                  [](const BadRows& a, const BadRows& b) { return a.rows.first < b.rows.first; });
        std::vector<BadRows> out;
        for (BadRows& bad : m_bad) {
            if (!out.empty() && out.back().rows.last + 1 == bad.rows.first)
                out.back().rows.last = bad.rows.last;
            else
                out.push_back(std::move(bad));
        }
        return out;
    }

  private:
    static std::optional<Error> failure_of(const Result<PlanarBlock>& block) {
        return block ? std::nullopt : std::optional(block.error());
    }

    Result<void> note(std::size_t block, const std::optional<Error>& failure) {
        const std::lock_guard lock(m_mutex);
        if (failure) {
            const RowRange rows = m_source.rows_of_block(block);
            m_bad.push_back(
                {{std::max(rows.first, m_rows.first), std::min(rows.last, m_rows.last)}, failure->what});
        }
        ++m_done;
        if (m_progress && !m_progress(static_cast<double>(m_done) / static_cast<double>(m_end - m_first)))
            return fail(ErrorCode::Cancelled, "interrupted");
        return {};
    }

    const BlockSource& m_source;
    const RowRange m_rows;
    const Progress& m_progress;
    const std::size_t m_first;
    const std::size_t m_end;
    std::atomic<std::size_t> m_next;
    std::atomic<bool> m_stopped = false;
    std::mutex m_mutex;
    std::size_t m_done = 0;
    std::vector<BadRows> m_bad;
    std::optional<Error> m_error;
};

class BlackRowsReader final : public BlockReader {
  public:
    BlackRowsReader(std::unique_ptr<BlockReader> reader, const BlockSource& source,
                    const std::vector<BadRows>& bad, const std::vector<SampleType>& types)
        : m_reader(std::move(reader)), m_source(source), m_bad(bad), m_types(types) {}

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const RowRange rows = m_source.rows_of_block(block);
        const auto overlaps = [&](const BadRows& bad) {
            return bad.rows.first <= rows.last && rows.first <= bad.rows.last;
        };
        if (std::any_of(m_bad.begin(), m_bad.end(), overlaps))
            return black(rows);
        return m_reader->read(block);
    }

  private:
    PlanarBlock black(RowRange rows) {
        const int count = rows.last - rows.first + 1;
        // The widest sample's bytes serve every plane; zero is 0 in each type.
        m_zeros.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(m_source.width()) *
                       sample_bytes(SampleType::Float));
        PlanarBlock out{rows.first, count, m_source.width(), {}};
        for (const SampleType type : m_types)
            out.planes.push_back({m_zeros.data(), type, static_cast<std::ptrdiff_t>(sample_bytes(type))});
        return out;
    }

    std::unique_ptr<BlockReader> m_reader;
    const BlockSource& m_source;
    const std::vector<BadRows>& m_bad;
    const std::vector<SampleType>& m_types;
    std::vector<std::byte> m_zeros;
};

class BlackRowsSource final : public WrappedSource {
  public:
    BlackRowsSource(std::unique_ptr<BlockSource> source, std::vector<BadRows> bad,
                    std::vector<SampleType> types)
        : WrappedSource(std::move(source)), m_bad(std::move(bad)), m_types(std::move(types)) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, inner().start_reader());
        return std::make_unique<BlackRowsReader>(std::move(reader), inner(), m_bad, m_types);
    }

  private:
    std::vector<BadRows> m_bad;
    std::vector<SampleType> m_types;
};

}  // namespace

Result<std::vector<BadRows>> find_bad_rows(const BlockSource& source, RowRange rows, Runner& runner,
                                           const Progress& progress) {
    Examination examination(source, rows, progress);
    runner.run([&](unsigned) {
        try {
            if (auto result = examination.work(); !result)
                examination.stop(std::move(result).error());
        } catch (const std::bad_alloc&) {
            examination.stop({ErrorCode::Io, "out of memory", {}});
        }
    });
    return examination.result();
}

Result<PartSoundness> examine_part(const std::shared_ptr<const ExrFile>& file, std::size_t index,
                                   Runner& runner, const Progress& progress) {
    const image::Part& part = file->parts()[index];
    PartSoundness out;
    if (part.deep)
        return out;
    PlaneChannels planes;
    std::vector<std::string> subsampled;
    for (std::size_t channel = 0; channel < part.channels.size(); ++channel) {
        if (part.channels[channel].subsampled)
            subsampled.push_back(part.channels[channel].name);
        else
            planes.emplace_back(channel);
    }
    if (!subsampled.empty())
        out.not_decoded.push_back("sub-sampled channels " + join(subsampled, ", "));
    if (part.tiled && part.header.tileDescription().mode != Imf::ONE_LEVEL)
        out.not_decoded.emplace_back("smaller levels");
    OSIO_TRY(const auto source, make_block_source(file, index, std::move(planes), Grain::Chunk));
    OSIO_TRY(out.bad,
             find_bad_rows(*source, {part.data_window.min_y, part.data_window.max_y}, runner, progress));
    out.decoded = true;
    return out;
}

std::unique_ptr<BlockSource> with_black_rows(std::unique_ptr<BlockSource> source, std::vector<BadRows> bad,
                                             std::vector<SampleType> types) {
    return std::make_unique<BlackRowsSource>(std::move(source), std::move(bad), std::move(types));
}

void note_missing_rows(const std::vector<BadRows>& bad, Imf::Header& header) {
    if (!bad.empty())
        header.insert(image::attribute::kMissingRows, Imf::StringAttribute(rows_text(bad)));
}

std::string rows_text(const std::vector<BadRows>& bad) {
    std::vector<std::string> out;
    for (const BadRows& run : bad)
        out.push_back(std::to_string(run.rows.first) + "-" + std::to_string(run.rows.last));
    return join(out, ",");
}

std::size_t row_count(const std::vector<BadRows>& bad) {
    std::size_t rows = 0;
    for (const BadRows& run : bad)
        rows += static_cast<std::size_t>(run.rows.last - run.rows.first + 1);
    return rows;
}

}  // namespace osio::exr
