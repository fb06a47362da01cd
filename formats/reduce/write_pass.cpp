// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/samples.h>
#include <formats/reduce/write_pass.h>

#include <osio/collapse/kernel.h>

#include <algorithm>
#include <cmath>

namespace osio::reduce {

namespace {

/// Pixels beyond the tolerance that are kept of each block, and of all.
constexpr std::size_t kKeptOfBlock = 8, kKept = 1024;

/// A worker's blocks: judged, packed, counted.
class Writing final : public BlockVisitor {
  public:
    Writing(const Subject& subject, const Candidate& candidate, double tolerance, exr::ExrWriter& writer,
            PassResult& result)
        : m_subject(subject), m_candidate(candidate), m_tolerance(tolerance), m_result(result),
          m_judge(subject, candidate), m_packer(writer.start_packer()), m_block(subject) {}

    void process(const PlanarBlock& block) override {
        m_judge.judge(block);
        m_block = PassResult(m_subject);
        m_block.counts = m_judge.counts();
        count(block);
        std::vector<exr::ChannelRows> rows;
        for (std::size_t channel = 0; channel < m_candidate.stored.size(); ++channel) {
            const SampleType type = m_candidate.stored[channel].type;
            const auto bytes = static_cast<std::ptrdiff_t>(sample_bytes(type));
            const bool plane = channel < m_candidate.matrix.rows();
            rows.push_back(
                {plane ? m_judge.stored(channel) : m_alpha.convert(block, m_subject.columns(), type), bytes,
                 bytes * block.width});
        }
        m_packed = m_packer->pack(block.first_row, block.row_count, rows);
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock&) override {
        OSIO_CHECK_OK(m_packed);
        for (std::size_t d = 0; d < m_block.found.size(); ++d) {
            const PassResult::Found& from = m_block.found[d];
            PassResult::Found& to = m_result.found[d];
            if (from.largest > to.largest) {
                to.largest = from.largest;
                to.largest_at = from.largest_at;
            }
            to.sum += from.sum;
            to.pixels += from.pixels;
            to.undefined += from.undefined;
        }
        m_result.counts += m_block.counts;
        m_result.unsampled += m_block.unsampled;
        for (std::size_t i = 0; i < m_block.beyond.size() && m_result.beyond.size() < kKept; ++i)
            m_result.beyond.add(m_block.beyond.pixel(i));
        return m_packer->write();
    }

  private:
    void count(const PlanarBlock& block) {
        const auto width = static_cast<std::size_t>(block.width);
        std::vector<std::pair<double, std::size_t>> beyond;
        for (std::size_t d = 0; d < m_block.found.size(); ++d) {
            PassResult::Found& found = m_block.found[d];
            const std::span<const double> differences = m_judge.differences(d);
            for (std::size_t i = 0; i < differences.size(); ++i) {
                if (std::isnan(differences[i])) {
                    ++found.undefined;
                    continue;
                }
                ++found.pixels;
                found.sum += differences[i];
                if (differences[i] > found.largest) {
                    found.largest = differences[i];
                    found.largest_at = {static_cast<int>(i % width),
                                        block.first_row + static_cast<int>(i / width)};
                }
                if (differences[i] > m_tolerance)
                    beyond.emplace_back(-differences[i], i);
            }
        }
        std::sort(beyond.begin(), beyond.end());
        beyond.resize(std::min(beyond.size(), kKeptOfBlock));
        std::vector<double> pixel(m_subject.columns());
        block.for_each_run([&](std::size_t first, std::size_t run, std::span<const BandView> planes) {
            for (const auto& [difference, at] : beyond) {
                if (at < first || at >= first + run)
                    continue;
                for (std::size_t band = 0; band < pixel.size(); ++band)
                    pixel[band] = planes[band].data == nullptr ? 0 : sample_at(planes[band], at - first);
                const std::size_t before = m_block.beyond.size();
                m_block.beyond.add(pixel);
                m_block.unsampled += m_block.beyond.size() == before;
            }
        });
    }

    const Subject& m_subject;
    const Candidate& m_candidate;
    double m_tolerance;
    PassResult& m_result;
    BlockJudge m_judge;
    std::unique_ptr<exr::ExrWriter::Packer> m_packer;
    convert::SampleBuffer m_alpha;
    PassResult m_block;
    Result<void> m_packed;
};

}  // namespace

bool PassResult::within(double tolerance) const {
    return std::all_of(found.begin(), found.end(),
                       [tolerance](const Found& one) { return one.largest <= tolerance; });
}

Result<PassResult> write_pass(const Subject& subject, const Candidate& candidate, double tolerance,
                              exr::ExrWriter& writer, Runner& runner, const Progress& progress) {
    OSIO_TRY(const auto source, subject.open_source(image::Grain::Block));
    const image::Window& window = subject.job().part().data_window;
    PassResult out(subject);
    const auto start = [&] { return std::make_unique<Writing>(subject, candidate, tolerance, writer, out); };
    OSIO_CHECK_OK(visit_blocks(*source, {window.min_y, window.max_y}, runner, start, progress));
    return out;
}

}  // namespace osio::reduce
