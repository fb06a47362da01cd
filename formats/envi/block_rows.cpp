// SPDX-License-Identifier: Apache-2.0
#include <formats/envi/block_rows.h>
#include <formats/image/even_rows.h>
#include <formats/image/limits.h>
#include <formats/image/number_rows.h>

#include <algorithm>

namespace osio::envi {

namespace {

constexpr std::uint64_t kMostRows = 64;

image::Scaling scaling_of(const EnviHeader& header, std::size_t band) {
    return {header.gain.empty() ? 1 : header.gain[band], header.offset.empty() ? 0 : header.offset[band],
            header.divisor, header.ignore_value};
}

/// What readers of one source share.
struct Job {
    std::shared_ptr<const EnviFile> file;
    image::PlaneChannels planes;
    int rows_per_block = 1;

    [[nodiscard]] const EnviHeader& header() const { return file->header(); }
};

class RowReader final : public BlockReader {
  public:
    explicit RowReader(const Job& job) : m_job(job), m_header(job.file->header()) {
        const std::uint64_t samples = m_header.samples * static_cast<std::uint64_t>(job.rows_per_block);
        for (const auto& channel : job.planes) {
            m_planes.emplace_back(channel ? samples : 0);
            m_scaling.push_back(channel ? scaling_of(m_header, *channel) : image::Scaling());
        }
    }

    [[nodiscard]] Result<PlanarBlock> read(std::size_t block) override {
        const auto rows = static_cast<std::uint64_t>(m_job.rows_per_block);
        const std::uint64_t first = block * rows;
        const std::uint64_t count = std::min(rows, m_header.lines - first);
        if (auto result =
                m_header.interleave == Interleave::Bsq ? read_bands(first, count) : read_lines(first, count);
            !result)
            return fail_in(m_job.file->data_path(), result.error());
        PlanarBlock out{
            static_cast<int>(first), static_cast<int>(count), static_cast<int>(m_header.samples), {}};
        for (const auto& plane : m_planes)
            out.planes.push_back({reinterpret_cast<const std::byte*>(plane.empty() ? nullptr : plane.data()),
                                  SampleType::Float, sizeof(float)});
        return out;
    }

  private:
    /// Some lines of one band after another.
    [[nodiscard]] Result<void> read_bands(std::uint64_t first, std::uint64_t count) {
        for (std::size_t plane = 0; plane < m_planes.size(); ++plane) {
            const auto band = m_job.planes[plane];
            if (!band)
                continue;
            const std::uint64_t numbers = count * m_header.samples;
            OSIO_CHECK_OK(fetch((*band * m_header.lines + first) * m_header.samples, numbers));
            convert(0, 1, numbers, plane, 0);
        }
        return {};
    }

    /// One line of all bands after another.
    [[nodiscard]] Result<void> read_lines(std::uint64_t first, std::uint64_t count) {
        const bool by_pixel = m_header.interleave == Interleave::Bip;
        const std::uint64_t line = m_header.samples * m_header.bands;
        for (std::uint64_t row = 0; row < count; ++row) {
            OSIO_CHECK_OK(fetch((first + row) * line, line));
            for (std::size_t plane = 0; plane < m_planes.size(); ++plane)
                if (const auto band = m_job.planes[plane])
                    convert(by_pixel ? *band : *band * m_header.samples, by_pixel ? m_header.bands : 1,
                            m_header.samples, plane, row * m_header.samples);
        }
        return {};
    }

    /// Numbers from the n-th on, to m_bytes.
    [[nodiscard]] Result<void> fetch(std::uint64_t n, std::uint64_t count) {
        const std::uint64_t bytes = data_bytes(m_header.type);
        return m_job.file->data().read(m_header.header_offset + n * bytes, count * bytes, m_bytes);
    }

    void convert(std::size_t from, std::size_t stride, std::size_t count, std::size_t plane, std::size_t to) {
        image::to_floats(reinterpret_cast<const std::byte*>(m_bytes.data()) +
                             from * data_bytes(m_header.type),
                         stride, count, number_type(m_header.type), m_header.big_endian, m_scaling[plane],
                         m_planes[plane].data() + to);
    }

    const Job& m_job;
    const EnviHeader& m_header;
    std::string m_bytes;
    std::vector<std::vector<float>> m_planes;
    std::vector<image::Scaling> m_scaling;
};

class RowSource final : public image::EvenRows {
  public:
    explicit RowSource(Job job)
        : EvenRows(static_cast<int>(job.header().samples), static_cast<int>(job.header().lines),
                   job.rows_per_block),
          m_job(std::move(job)) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        return std::make_unique<RowReader>(m_job);
    }

  private:
    Job m_job;
};

}  // namespace

Result<std::unique_ptr<BlockSource>> make_row_source(std::shared_ptr<const EnviFile> file,
                                                     image::PlaneChannels planes, image::Grain grain) {
    const EnviHeader& header = file->header();
    const auto wanted = static_cast<std::uint64_t>(
        std::count_if(planes.begin(), planes.end(), [](const auto& plane) { return plane.has_value(); }));
    const std::uint64_t stored = header.interleave == Interleave::Bsq ? 1 : header.bands;
    const std::uint64_t row_bytes =
        header.samples * (wanted * sizeof(float) + stored * data_bytes(header.type));
    if (row_bytes > image::kMostBlockBytes)
        return fail(ErrorCode::Damaged,
                    "a row needs more than " + std::to_string(image::kMostBlockBytes) + " bytes",
                    file->path());
    const std::uint64_t rows =
        grain == image::Grain::Chunk
            ? 1
            : std::clamp<std::uint64_t>(image::EvenRows::kBlockBytes / row_bytes, 1, kMostRows);
    return std::make_unique<RowSource>(
        Job{std::move(file), std::move(planes), static_cast<int>(std::min(rows, header.lines))});
}

}  // namespace osio::envi
