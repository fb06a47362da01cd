// SPDX-License-Identifier: Apache-2.0
#include <formats/reduce/sample.h>

#include <osio/collapse/kernel.h>

#include <algorithm>
#include <cmath>

namespace osio::reduce {

namespace {

constexpr std::size_t kBlocks = 16, kPixels = 4096;

/// A sample as a block of one row. The planes live as long as it.
struct SampleBlock {
    explicit SampleBlock(const SpectrumSample& sample) : planes(sample.bands()) {
        block = {0, 1, static_cast<int>(sample.size()), {}, 0};
        for (std::size_t band = 0; band < planes.size(); ++band) {
            for (std::size_t i = 0; i < sample.size(); ++i)
                planes[band].push_back(static_cast<float>(sample.pixel(i)[band]));
            block.planes.push_back(
                {reinterpret_cast<const std::byte*>(planes[band].data()), SampleType::Float, sizeof(float)});
        }
    }

    std::vector<std::vector<float>> planes;
    PlanarBlock block;
};

}  // namespace

Result<SpectrumSample> sample_image(const Subject& subject, Runner& runner, const Progress& progress) {
    OSIO_TRY(const auto source, subject.open_source(image::Grain::Chunk));
    const std::size_t blocks = std::min(kBlocks, source->block_count());
    std::vector<SpectrumSample> found(blocks, SpectrumSample(subject.columns()));
    std::vector<Result<void>> results(blocks);
    const auto take = [&](BlockReader& reader, std::size_t index) -> Result<void> {
        const std::size_t share = kPixels / blocks;
        OSIO_TRY(const PlanarBlock block, reader.read(index * source->block_count() / blocks));
        const std::size_t pixels =
            static_cast<std::size_t>(block.row_count) * static_cast<std::size_t>(block.width);
        std::vector<double> pixel(subject.columns());
        block.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
            for (std::size_t i = 0; i < std::min(share, pixels); ++i) {
                const std::size_t at = i * pixels / std::min(share, pixels);
                if (at < first || at >= first + count)
                    continue;
                for (std::size_t band = 0; band < pixel.size(); ++band)
                    pixel[band] = planes[band].data == nullptr ? 0 : sample_at(planes[band], at - first);
                found[index].add(pixel);
            }
        });
        return {};
    };
    runner.run([&](unsigned worker) {
        const auto reader = source->start_reader();
        for (std::size_t index = worker; index < blocks; index += runner.worker_count())
            results[index] = reader ? take(**reader, index) : tl::unexpected(reader.error());
    });
    if (progress && !progress(0))
        return fail(ErrorCode::Cancelled, "interrupted");
    SpectrumSample out(subject.columns());
    for (std::size_t index = 0; index < blocks; ++index) {
        OSIO_CHECK_OK(results[index]);
        for (std::size_t i = 0; i < found[index].size(); ++i)
            out.add(found[index].pixel(i));
    }
    return out;
}

std::vector<double> largest_differences(const Subject& subject, const Candidate& candidate,
                                        const SpectrumSample& sample) {
    std::vector<double> out(subject.demands.size(), 0.0);
    if (sample.size() == 0)
        return out;
    const SampleBlock block(sample);
    BlockJudge judge(subject, candidate);
    judge.judge(block.block);
    for (std::size_t d = 0; d < out.size(); ++d)
        for (const double delta : judge.differences(d))
            out[d] = std::max(out[d], delta);
    return out;
}

SpectrumLoss spectrum_loss(const Subject& subject, const Candidate& candidate, const SpectrumSample& sample) {
    SpectrumLoss out;
    const bool scene = candidate.expansion.rows() > 0;
    if ((candidate.edges_nm.empty() && !scene) || sample.size() == 0)
        return out;
    const SampleBlock block(sample);
    BlockJudge judge(subject, candidate);
    judge.judge(block.block);
    double sum = 0;
    std::size_t count = 0, needed = 0;
    for (std::size_t column = 0; column < subject.columns(); ++column) {
        if (!subject.weights.needs(column))
            continue;
        const double nm = subject.job().plan.columns[column].wavelength_nm;
        const auto& edges = candidate.edges_nm;
        if (!scene && (nm < edges.front() || nm > edges.back()))
            continue;
        const auto bin = [&] {
            const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, nm);
            return static_cast<std::size_t>(above - edges.begin()) - 1;
        };
        const BandView read = judge.read(scene ? needed++ : bin());
        for (std::size_t i = 0; i < sample.size(); ++i) {
            const double away = std::abs(sample_at(read, i) - sample.pixel(i)[column]);
            out.largest = std::max(out.largest, away);
            sum += away * away;
            ++count;
        }
    }
    out.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
    return out;
}

}  // namespace osio::reduce
