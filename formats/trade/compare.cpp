// SPDX-License-Identifier: Apache-2.0
#include <formats/image/open_image.h>
#include <formats/trade/compare.h>
#include <formats/trade/rows_beside.h>

#include <osio/collapse/kernel.h>
#include <osio/colour/difference.h>

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace osio::trade {

namespace {

using Planes = std::array<std::vector<float>, 3>;

struct Comparison {
    const Choices& choices;
    const Spectator& show;
    std::size_t width = 0;
    int first_row = 0;
    /// The last row that a proxy kept, by choice: a proxy's rows may come with the next block.
    std::vector<Planes> kept_rows;
    std::vector<std::unique_ptr<BlockSource>> reduced;  ///< by choice; null but of reduced images
};

/// The block's bands, rounded to half.
class HalfBlock {
  public:
    const std::vector<BandView>& of(std::span<const BandView> bands, std::size_t count) {
        m_samples.resize(bands.size());
        m_views.clear();
        for (std::size_t band = 0; band < bands.size(); ++band) {
            if (bands[band].data == nullptr) {
                m_views.push_back(bands[band]);
                continue;
            }
            m_samples[band].resize(count);
            for (std::size_t i = 0; i < count; ++i)
                m_samples[band][i] = Imath::half(std::clamp(static_cast<float>(sample_at(bands[band], i)),
                                                            -65504.0F, 65504.0F))
                                         .bits();
            m_views.push_back(
                {reinterpret_cast<const std::byte*>(m_samples[band].data()), SampleType::Half, 2});
        }
        return m_views;
    }

  private:
    std::vector<std::vector<std::uint16_t>> m_samples;
    std::vector<BandView> m_views;
};

class Comparer final : public BlockVisitor {
  public:
    explicit Comparer(Comparison& comparison)
        : m_shared(comparison), m_outputs(comparison.choices.list.size()), m_deltas(m_outputs.size()),
          m_largest(m_outputs.size()) {
        for (const auto& source : comparison.reduced)
            m_beside.push_back(source ? std::make_unique<RowsBeside>(*source) : nullptr);
    }

    void process(const PlanarBlock& block) override {
        const std::size_t pixels = static_cast<std::size_t>(block.row_count) * m_shared.width;
        for (Planes& planes : m_outputs)
            for (std::vector<float>& plane : planes)
                plane.resize(pixels);
        block.for_each_run([this](std::size_t first, std::size_t count, std::span<const BandView> bands) {
            sum(first, count, bands);
        });
        m_status = {};
        for (std::size_t choice = 0; choice < m_outputs.size() && m_status; ++choice)
            if (m_beside[choice] != nullptr)
                m_status = sum_reduced(choice, block, pixels);
        make_reference(pixels);
        for (std::size_t choice = 0; choice < m_outputs.size(); ++choice)
            if (m_shared.choices.list[choice].row_step == 1)
                compare(choice, pixels);
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock& block) override {
        OSIO_CHECK_OK(m_status);
        for (std::size_t choice = 0; choice < m_outputs.size(); ++choice) {
            if (m_shared.choices.list[choice].row_step > 1) {
                repeat_rows(choice, block);
                compare(choice, m_reference.size());
            }
            const Planes& planes = m_outputs[choice];
            m_shared.show({choice,
                           block.first_row,
                           block.row_count,
                           {planes[0].data(), planes[1].data(), planes[2].data()},
                           m_deltas[choice],
                           m_largest[choice]});
        }
        return {};
    }

  private:
    void sum(std::size_t first, std::size_t count, std::span<const BandView> bands) {
        for (std::size_t choice = 0; choice < m_outputs.size(); ++choice) {
            const Choice& what = m_shared.choices.list[choice];
            if (what.input == Input::ReducedImage)
                continue;
            const std::array<float*, 3> out{m_outputs[choice][0].data() + first,
                                            m_outputs[choice][1].data() + first,
                                            m_outputs[choice][2].data() + first};
            if (what.level == Level::Reference)
                collapse_run_reference(bands, what.weights, count, out);
            else
                collapse_run(what.input == Input::HalfImage ? m_halves.of(bands, count) : bands, what.weights,
                             count, out);
            if (what.half_output)
                for (float* const plane : out)
                    for (std::size_t i = 0; i < count; ++i)
                        plane[i] = Imath::half(std::clamp(plane[i], -65504.0F, 65504.0F));
        }
    }

    [[nodiscard]] Result<void> sum_reduced(std::size_t choice, const PlanarBlock& block, std::size_t pixels) {
        OSIO_TRY(const std::span<const BandView> bands,
                 m_beside[choice]->read({block.first_row, block.first_row + block.row_count - 1}));
        Planes& planes = m_outputs[choice];
        const std::array<float*, 3> out{planes[0].data(), planes[1].data(), planes[2].data()};
        collapse_run(bands, m_shared.choices.list[choice].file_weights, pixels, out);
        return {};
    }

    [[nodiscard]] Vector3 share(std::size_t choice, std::size_t pixel) const {
        const Planes& planes = m_outputs[choice];
        return m_shared.choices.share_from_output * Vector3{static_cast<double>(planes[0][pixel]),
                                                            static_cast<double>(planes[1][pixel]),
                                                            static_cast<double>(planes[2][pixel])};
    }

    void make_reference(std::size_t pixels) {
        m_reference.clear();
        m_reference_lab.clear();
        for (std::size_t i = 0; i < pixels; ++i) {
            m_reference.push_back(share(0, i));
            m_reference_lab.push_back(lab_of(m_reference.back(), {1, 1, 1}));
        }
    }

    /// One pixel's colour against the reference's.
    void judge(std::size_t choice, std::size_t pixel, const Vector3& found) {
        const Vector3& wanted = m_reference[pixel];
        double delta = 0;
        if (found != wanted) {
            delta = delta_e_2000(m_reference_lab[pixel], lab_of(found, {1, 1, 1}));
            for (std::size_t c = 0; c < 3; ++c)
                if (const double away = std::abs(found[c] - wanted[c]); std::isfinite(away))
                    m_largest[choice] = std::max(m_largest[choice], away);
        }
        m_deltas[choice].push_back(static_cast<float>(delta));
    }

    void compare(std::size_t choice, std::size_t pixels) {
        m_deltas[choice].clear();
        m_largest[choice] = 0;
        for (std::size_t i = 0; i < pixels; ++i)
            judge(choice, i, share(choice, i));
    }

    /// Puts the rows that a proxy makes in the place of those that it leaves out.
    void repeat_rows(std::size_t choice, const PlanarBlock& block) {
        const auto width = static_cast<std::ptrdiff_t>(m_shared.width);
        Planes& kept = m_shared.kept_rows[choice];
        for (int row = 0; row < block.row_count; ++row) {
            const bool made =
                (block.first_row + row - m_shared.first_row) % m_shared.choices.list[choice].row_step == 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const auto from = m_outputs[choice][c].begin() + row * width;
                if (made)
                    kept[c].assign(from, from + width);
                else
                    std::copy(kept[c].begin(), kept[c].end(), from);
            }
        }
    }

    Comparison& m_shared;
    HalfBlock m_halves;
    std::vector<Planes> m_outputs;  ///< by choice
    std::vector<Vector3> m_reference;
    std::vector<Lab> m_reference_lab;
    std::vector<std::vector<float>> m_deltas;  ///< by choice, of the block
    std::vector<double> m_largest;
    std::vector<std::unique_ptr<RowsBeside>> m_beside;  ///< by choice; null but of reduced images
    Result<void> m_status;
};

}  // namespace

Result<void> compare(const image::CollapseJob& job, const Choices& choices, Runner& runner,
                     const Progress& progress, const Spectator& show) {
    OSIO_TRY(const auto source,
             job.file->make_block_source(job.part_index, choices.planes, image::Grain::Block));
    const image::Window& window = job.part().data_window;
    Comparison comparison{choices,
                          show,
                          static_cast<std::size_t>(window.width()),
                          window.min_y,
                          std::vector<Planes>(choices.list.size()),
                          {}};
    for (const Choice& choice : choices.list) {
        comparison.reduced.emplace_back();
        if (choice.input != Input::ReducedImage)
            continue;
        OSIO_TRY(const auto file, image::open_image(choice.path));
        OSIO_TRY(comparison.reduced.back(),
                 file->make_block_source(0, choice.file_planes, image::Grain::Block));
    }
    const auto start = [&] { return std::make_unique<Comparer>(comparison); };
    return visit_blocks(*source, {window.min_y, window.max_y}, runner, start, progress);
}

}  // namespace osio::trade
