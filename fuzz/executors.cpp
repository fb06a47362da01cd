// SPDX-License-Identifier: Apache-2.0
//
// Fast and obvious executors on the same bytes give the same bits.
#include <osio/collapse/kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fuzz/target.h>
#include <vector>

namespace {

/// Takes numbers from the bytes; 0 when they are used up.
class Source {
  public:
    Source(const std::uint8_t* bytes, std::size_t count) : m_bytes(bytes), m_left(count) {}

    std::uint8_t byte() {
        if (m_left == 0)
            return 0;
        --m_left;
        return *m_bytes++;
    }

    template <class T>
    T number() {
        std::array<std::uint8_t, sizeof(T)> raw{};
        for (std::uint8_t& b : raw)
            b = byte();
        T out{};
        std::memcpy(&out, raw.data(), sizeof out);
        return out;
    }

  private:
    const std::uint8_t* m_bytes;
    std::size_t m_left;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
    Source source(bytes, count);
    const std::size_t bands = source.byte() % 12U + 1U, pixels = source.byte() % 70U + 1U;
    osio::WeightMatrix weights(3, bands);
    std::vector<std::vector<std::byte>> memory;
    std::vector<osio::BandView> views;
    for (std::size_t band = 0; band < bands; ++band) {
        const auto type = static_cast<osio::SampleType>(source.byte() % 3U);
        const std::size_t size = osio::sample_bytes(type), skip = source.byte() % 8U;
        for (std::size_t row = 0; row < 3; ++row) {
            const auto weight = source.number<double>();
            weights.at(row, band) = std::isfinite(weight) ? weight : 0;
        }
        memory.emplace_back(skip + pixels * size);
        for (std::byte& b : memory.back())
            b = std::byte{source.byte()};
        views.push_back({memory.back().data() + skip, type, static_cast<std::ptrdiff_t>(size)});
    }
    std::array<std::vector<float>, 6> out;
    std::array<float*, 3> fast{}, obvious{};
    for (std::size_t row = 0; row < 6; ++row) {
        out[row].resize(pixels);
        (row < 3 ? fast[row] : obvious[row - 3]) = out[row].data();
    }
    osio::collapse_run(views, weights, pixels, fast);
    osio::collapse_run_reference(views, weights, pixels, obvious);
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            osio::fuzz::require(std::memcmp(&fast[row][pixel], &obvious[row][pixel], sizeof(float)) == 0 ||
                                (std::isnan(fast[row][pixel]) && std::isnan(obvious[row][pixel])));
    return 0;
}
