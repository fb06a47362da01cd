// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/joined_rows.h>
#include <formats/image/open_image.h>
#include <formats/trade/compare.h>

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
    std::vector<std::size_t> first_plane;  ///< by choice, of those that its weights are for
};

/// The image's planes, then those of every reduced image.
Result<std::unique_ptr<BlockSource>> join_planes(const image::CollapseJob& job, const Choices& choices,
                                                 std::vector<std::size_t>& first_plane) {
    std::vector<std::unique_ptr<BlockSource>> sources;
    std::vector<convert::JoinedPlane> joined;
    const auto add = [&](const image::SpectralImage& file, std::size_t part,
                         const image::PlaneChannels& planes) -> Result<void> {
        for (std::size_t plane = 0; plane < planes.size(); ++plane)
            joined.push_back({sources.size(), plane});
        OSIO_TRY(auto source, file.make_block_source(part, planes, image::Grain::Block));
        sources.push_back(std::move(source));
        return {};
    };
    OSIO_CHECK_OK(add(*job.file, job.part_index, choices.planes));
    for (const Choice& choice : choices.list) {
        const bool reduced = choice.input == Input::ReducedImage;
        first_plane.push_back(reduced ? joined.size() : 0);
        if (reduced) {
            OSIO_TRY(const auto file, image::open_image(choice.path));
            OSIO_CHECK_OK(add(*file, 0, choice.file_planes));
        }
    }
    return convert::join_sources(std::move(sources), std::move(joined));
}

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
          m_largest(m_outputs.size()) {}

    void process(const PlanarBlock& block) override {
        const std::size_t pixels = static_cast<std::size_t>(block.row_count) * m_shared.width;
        for (Planes& planes : m_outputs)
            for (std::vector<float>& plane : planes)
                plane.resize(pixels);
        block.for_each_run([this](std::size_t first, std::size_t count, std::span<const BandView> bands) {
            sum(first, count, bands);
        });
        make_reference(pixels);
        for (std::size_t choice = 0; choice < m_outputs.size(); ++choice)
            if (m_shared.choices.list[choice].row_step == 1)
                compare(choice, pixels);
    }

    [[nodiscard]] Result<void> deliver(const PlanarBlock& block) override {
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
            const std::array<float*, 3> out{m_outputs[choice][0].data() + first,
                                            m_outputs[choice][1].data() + first,
                                            m_outputs[choice][2].data() + first};
            const auto own = bands.subspan(m_shared.first_plane[choice], what.weights.bands());
            if (what.level == Level::Reference)
                collapse_run_reference(own, what.weights, count, out);
            else
                collapse_run(what.input == Input::HalfImage ? m_halves.of(own, count) : own, what.weights,
                             count, out);
            if (what.half_output)
                for (float* const plane : out)
                    for (std::size_t i = 0; i < count; ++i)
                        plane[i] = Imath::half(std::clamp(plane[i], -65504.0F, 65504.0F));
        }
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
};

}  // namespace

Result<void> compare(const image::CollapseJob& job, const Choices& choices, Runner& runner,
                     const Progress& progress, const Spectator& show) {
    std::vector<std::size_t> first_plane;
    OSIO_TRY(const auto source, join_planes(job, choices, first_plane));
    const image::Window& window = job.part().data_window;
    Comparison comparison{choices,
                          show,
                          static_cast<std::size_t>(window.width()),
                          window.min_y,
                          std::vector<Planes>(choices.list.size()),
                          std::move(first_plane)};
    const auto start = [&] { return std::make_unique<Comparer>(comparison); };
    return visit_blocks(*source, {window.min_y, window.max_y}, runner, start, progress);
}

}  // namespace osio::trade
