// SPDX-License-Identifier: Apache-2.0
//
// The sums over bands of data in memory against the memory's bandwidth, and against other ways to make them.
//
//     cmake --build --preset release --target kernel_bench
//     build/release/bench/kernel_bench [--threads 2] [--rounds 7] [--size 1920x1080]
#include <osio/collapse/kernel.h>

#include <Imath/half.h>

#include <atomic>
#include <bench/contest.h>
#include <bench/kernel_variants.h>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>

namespace {

using namespace osio;
using namespace osio::bench;

/// Reads every byte, as fast as a loop of loads can.
__attribute__((target_clones("avx512f", "avx2", "default"))) std::uint64_t read_all(const std::uint64_t* data,
                                                                                    std::size_t count) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum ^= data[i];
    return sum;
}

constexpr std::size_t kBands = 31;

WeightMatrix weights_of(std::size_t rows) {
    WeightMatrix out(rows, kBands);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t band = 0; band < kBands; ++band)
            out.at(row, band) = 0.01 * static_cast<double>(1 + row + band);
    return out;
}

using Kernel = void (*)(std::span<const BandView>, const WeightMatrix&, std::size_t, std::span<float* const>);

/// Planar data of 31 bands that no cache holds, in EXR's order of lines.
class Image {
  public:
    explicit Image(SampleType type)
        : m_type(type), m_width(static_cast<std::size_t>(contest().width)),
          m_lines(static_cast<std::size_t>(contest().height) * (type == SampleType::Half ? 2 : 1)),
          m_data(m_lines * line_bytes() / 8), m_out(contest().threads, std::vector<float>(12 * m_width)) {
        std::minstd_rand random(1);
        for (std::size_t i = 0; i < m_data.size() * 8 / sample_bytes(type); ++i) {
            const float value = static_cast<float>(random() % 1000) / 1000.0F;
            const std::uint16_t half = Imath::half(value).bits();
            std::memcpy(bytes() + i * sample_bytes(type),
                        type == SampleType::Half ? static_cast<const void*>(&half) : &value,
                        sample_bytes(type));
        }
    }

    [[nodiscard]] std::size_t lines() const { return m_lines; }

    [[nodiscard]] double pixels() const { return static_cast<double>(m_lines * m_width); }

    [[nodiscard]] double megabytes() const { return static_cast<double>(m_data.size() * 8) / 1e6; }

    void read() {
        const std::size_t words = line_bytes() / 8;
        spread(m_lines,
               [&](unsigned, std::size_t line) { m_kept ^= read_all(&m_data[line * words], words); });
    }

    /// Some lines, several times.
    void collapse(Kernel kernel, const WeightMatrix& weights, std::size_t lines, std::size_t times) {
        spread(times * lines, [&](unsigned worker, std::size_t line) {
            std::vector<BandView> bands;
            for (std::size_t band = 0; band < kBands; ++band)
                bands.push_back(
                    {bytes() + (line % lines) * line_bytes() + band * m_width * sample_bytes(m_type), m_type,
                     static_cast<std::ptrdiff_t>(sample_bytes(m_type))});
            std::vector<float*> rows;
            for (std::size_t row = 0; row < weights.rows(); ++row)
                rows.push_back(m_out[worker].data() + row * m_width);
            kernel(bands, weights, m_width, rows);
        });
    }

  private:
    [[nodiscard]] std::size_t line_bytes() const { return kBands * m_width * sample_bytes(m_type); }

    [[nodiscard]] std::byte* bytes() { return reinterpret_cast<std::byte*>(m_data.data()); }

    SampleType m_type;
    std::size_t m_width, m_lines;
    std::vector<std::uint64_t> m_data;
    std::vector<std::vector<float>> m_out;
    std::atomic<std::uint64_t> m_kept = 0;
};

void bench_memory(SampleType type) {
    Image image(type);
    const WeightMatrix one = weights_of(1), three = weights_of(3), twelve = weights_of(12);
    const std::size_t lines = image.lines(), hot = contest().threads;
    const auto ms =
        medians({{"read", [&] { image.read(); }},
                 {"1", [&] { image.collapse(collapse_run, one, lines, 1); }},
                 {"3", [&] { image.collapse(collapse_run, three, lines, 1); }},
                 {"12", [&] { image.collapse(collapse_run, twelve, lines, 1); }},
                 {"fused", [&] { image.collapse(collapse_fused, three, lines, 1); }},
                 {"float", [&] { image.collapse(collapse_float, three, lines, 1); }},
                 {"hot", [&] { image.collapse(collapse_run, three, hot, lines / hot); }},
                 {"fused hot", [&] { image.collapse(collapse_fused, three, hot, lines / hot); }},
                 {"float hot", [&] { image.collapse(collapse_float, three, hot, lines / hot); }}});
    std::printf("| %s | %.1f |", std::string(sample_type_name(type)).c_str(), image.megabytes() / ms[0]);
    for (std::size_t i = 1; i <= 5; ++i)
        std::printf(" %.0f %% |", 100 * ms[0] / ms[i]);
    for (std::size_t i = 6; i <= 8; ++i)
        std::printf(" %.2f |", ms[i] * 1e6 * contest().threads / image.pixels());
    std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
    read_options(argc, argv);
    std::printf(
        "%u threads, medians of %d\n\n"
        "| samples | read, GB/s | exact, 1 output | 3 | 12 | 3, fused | 3, in float | exact, in cache, "
        "ns | fused | float |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n",
        contest().threads, contest().rounds);
    bench_memory(SampleType::Float);
    bench_memory(SampleType::Half);
    return 0;
}
