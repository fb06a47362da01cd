// SPDX-License-Identifier: Apache-2.0
#include <formats/exr/scaled_source.h>

#include <osio/collapse/kernel.h>

#include <cstring>
#include <span>
#include <utility>

namespace osio::exr {

namespace {

class ScaledReader final : public BlockReader {
  public:
    ScaledReader(std::unique_ptr<BlockReader> reader, std::span<const double> factors)
        : m_reader(std::move(reader)), m_factors(factors), m_planes(factors.size()) {}

    /// Planes lose what lies between their rows, so that all have the same pitch.
    [[nodiscard]] Result<PlanarBlock> read(std::size_t index) override {
        OSIO_TRY(const PlanarBlock block, m_reader->read(index));
        const std::size_t pixels =
            static_cast<std::size_t>(block.row_count) * static_cast<std::size_t>(block.width);
        PlanarBlock out = block;
        out.row_pitch_bytes = 0;
        for (std::size_t plane = 0; plane < block.planes.size(); ++plane) {
            if (block.planes[plane].data == nullptr)
                continue;
            const SampleType type = m_factors[plane] == 1 ? block.planes[plane].type : SampleType::Float;
            m_planes[plane].resize(pixels * sample_bytes(type));
            out.planes[plane] = {m_planes[plane].data(), type,
                                 static_cast<std::ptrdiff_t>(sample_bytes(type))};
        }
        block.for_each_run([&](std::size_t first, std::size_t count, std::span<const BandView> planes) {
            for (std::size_t plane = 0; plane < planes.size(); ++plane)
                if (planes[plane].data != nullptr)
                    copy(planes[plane], plane, first, count);
        });
        return out;
    }

  private:
    void copy(const BandView& from, std::size_t plane, std::size_t first, std::size_t count) {
        const double factor = m_factors[plane];
        for (std::size_t i = 0; i < count; ++i) {
            if (factor == 1) {
                const std::size_t bytes = sample_bytes(from.type);
                std::memcpy(m_planes[plane].data() + (first + i) * bytes, from.advanced(i).data, bytes);
                continue;
            }
            const auto value = static_cast<float>(sample_at(from, i) * factor);
            std::memcpy(m_planes[plane].data() + (first + i) * sizeof value, &value, sizeof value);
        }
    }

    std::unique_ptr<BlockReader> m_reader;
    std::span<const double> m_factors;
    std::vector<std::vector<std::byte>> m_planes;
};

class ScaledSource final : public WrappedSource {
  public:
    ScaledSource(std::unique_ptr<BlockSource> source, std::vector<double> factors)
        : WrappedSource(std::move(source)), m_factors(std::move(factors)) {}

    [[nodiscard]] Result<std::unique_ptr<BlockReader>> start_reader() const override {
        OSIO_TRY(auto reader, inner().start_reader());
        return std::make_unique<ScaledReader>(std::move(reader), m_factors);
    }

  private:
    std::vector<double> m_factors;
};

}  // namespace

std::unique_ptr<BlockSource> with_factors(std::unique_ptr<BlockSource> source, std::vector<double> factors) {
    return std::make_unique<ScaledSource>(std::move(source), std::move(factors));
}

}  // namespace osio::exr
