// SPDX-License-Identifier: Apache-2.0
//
// The fast executor against the obvious one, to the last bit: pixel counts x bands x types x
// misalignment x instruction sets.
#include <osio/base/half.h>
#include <osio/collapse/kernel.h>

#include <Imath/half.h>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace osio {
namespace {

TEST(Half, EveryPatternIsTheNumberThatImathGives) {
    for (std::uint32_t bits = 0; bits <= 0xFFFF; ++bits) {
        Imath::half expected;
        expected.setBits(static_cast<std::uint16_t>(bits));
        const float actual = float_from_half(static_cast<std::uint16_t>(bits));
        if (expected.isNan())
            EXPECT_TRUE(std::isnan(actual)) << bits;
        else
            EXPECT_EQ(std::bit_cast<std::uint32_t>(actual),
                      std::bit_cast<std::uint32_t>(static_cast<float>(expected)))
                << bits;
    }
}

/// Samples of some bands at a chosen misalignment, with weights, some of them zero.
class Case {
  public:
    Case(std::mt19937& random, std::size_t pixels, std::size_t bands, std::size_t offset_samples,
         const std::vector<SampleType>& types, std::size_t rows = 3)
        : weights(rows, bands), m_pixels(pixels) {
        std::uniform_real_distribution<double> weight(-1, 1);
        std::uniform_real_distribution<float> sample(-2, 2);
        for (std::size_t band = 0; band < bands; ++band) {
            const SampleType type = types[band % types.size()];
            const std::size_t size = sample_bytes(type);
            m_memory.emplace_back(64 + (pixels + offset_samples) * size);
            void* at = m_memory.back().data();
            std::size_t space = m_memory.back().size();
            auto* first = static_cast<std::byte*>(std::align(32, 1, at, space)) + offset_samples * size;
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                put(type, first + pixel * size, sample(random));
            views.push_back({first, type, static_cast<std::ptrdiff_t>(size)});
            for (std::size_t row = 0; row < rows; ++row)
                weights.at(row, band) = random() % 5 == 0 ? 0.0 : weight(random);
        }
    }

    static void put(SampleType type, std::byte* at, float value) {
        if (type == SampleType::Half) {
            const auto bits = Imath::half(value).bits();
            std::memcpy(at, &bits, sizeof bits);
        } else if (type == SampleType::Float) {
            std::memcpy(at, &value, sizeof value);
        } else {
            const auto whole = static_cast<std::uint32_t>(std::abs(value) * 1e9F);
            std::memcpy(at, &whole, sizeof whole);
        }
    }

    std::byte* sample(std::size_t band, std::size_t pixel) {
        return const_cast<std::byte*>(views[band].advanced(pixel).data);
    }

    /// Runs an executor between red zones that it must not touch.
    template <class Executor>
    std::vector<std::vector<float>> run(Executor executor) const {
        constexpr std::size_t kRed = 64;
        constexpr float kMark = -12345.5F;
        std::vector<std::vector<float>> memory(weights.rows(),
                                               std::vector<float>(m_pixels + 2 * kRed, kMark));
        std::vector<float*> out;
        for (auto& row : memory)
            out.push_back(row.data() + kRed);
        executor(views, weights, m_pixels, out);
        for (auto& row : memory) {
            for (std::size_t i = 0; i < kRed; ++i) {
                EXPECT_EQ(row[i], kMark);
                EXPECT_EQ(row[m_pixels + kRed + i], kMark);
            }
            row = {row.begin() + kRed, row.end() - kRed};
        }
        return memory;
    }

    std::vector<BandView> views;
    WeightMatrix weights;

  private:
    std::size_t m_pixels;
    std::vector<std::vector<std::byte>> m_memory;
};

void expect_same_bits(const std::vector<std::vector<float>>& a, const std::vector<std::vector<float>>& b) {
    for (std::size_t row = 0; row < a.size(); ++row)
        for (std::size_t pixel = 0; pixel < a[row].size(); ++pixel) {
            if (std::isnan(a[row][pixel]) && std::isnan(b[row][pixel]))
                continue;
            ASSERT_EQ(std::bit_cast<std::uint32_t>(a[row][pixel]),
                      std::bit_cast<std::uint32_t>(b[row][pixel]))
                << "row " << row << " pixel " << pixel;
        }
}

TEST(IsZero, HoldsWhereNoBitOfAnySampleIsSet) {
    std::mt19937 random(11);
    for (const SampleType type : {SampleType::Half, SampleType::Float, SampleType::Uint})
        for (const std::size_t pixels : {1U, 2U, 3U, 17U, 100U}) {
            const std::size_t bytes = pixels * sample_bytes(type);
            std::vector<std::byte> memory(bytes + 2, std::byte{0xFF});
            std::memset(memory.data() + 1, 0, bytes);
            const BandView band{memory.data() + 1, type, static_cast<std::ptrdiff_t>(sample_bytes(type))};
            EXPECT_TRUE(is_zero(band, pixels));
            for (std::size_t bit = 0; bit < 8 * bytes; ++bit) {
                memory[1 + bit / 8] = static_cast<std::byte>(1U << bit % 8);
                EXPECT_FALSE(is_zero(band, pixels)) << pixels << " bit " << bit;
                memory[1 + bit / 8] = std::byte{};
            }
        }
    EXPECT_FALSE(is_zero({}, 4));
}

/// Runs a test once for each instruction set that this machine has.
class KernelOn : public testing::TestWithParam<std::int64_t> {
  protected:
    void SetUp() override {
        hwy::SetSupportedTargetsForTest(GetParam());
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }

    void TearDown() override {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

const std::vector<std::vector<SampleType>> kTypes{{SampleType::Half},
                                                  {SampleType::Float},
                                                  {SampleType::Half, SampleType::Float},
                                                  {SampleType::Uint, SampleType::Float}};

TEST_P(KernelOn, FastAndReferenceAgreeToTheLastBit) {
    std::mt19937 random(1234);
    const std::size_t step = 32;  // pixels of a group on the widest instruction set
    for (const std::size_t pixels : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{7}, step - 1,
                                     step, step + 1, 3 * step, 8 * step + 2, std::size_t{1000}})
        for (const std::size_t bands : {1U, 2U, 8U, 31U, 81U, 401U})
            for (const std::size_t offset : {0U, 1U, 3U})
                for (const auto& types : kTypes) {
                    const Case test(random, pixels, bands, offset, types);
                    SCOPED_TRACE(testing::Message()
                                 << pixels << " pixels, " << bands << " bands, offset " << offset);
                    expect_same_bits(test.run(collapse_run), test.run(collapse_run_reference));
                }
}

TEST_P(KernelOn, SpecialValuesAreTheSame) {
    std::mt19937 random(99);
    for (const auto& types : {kTypes[0], kTypes[1]}) {
        Case test(random, 200, 5, 0, types);
        const float inf = std::numeric_limits<float>::infinity();
        const std::vector<float> special{
            inf,   -inf,   std::numeric_limits<float>::quiet_NaN(), 0.0F, -0.0F, 1e-45F, 5.9e-8F, 65504.0F,
            3e38F, -1e-40F};
        for (std::size_t band = 0; band < 5; ++band)
            for (std::size_t i = 0; i < special.size(); ++i)
                Case::put(types[0], test.sample(band, 17 * i + band), special[i]);
        expect_same_bits(test.run(collapse_run), test.run(collapse_run_reference));
    }
}

TEST_P(KernelOn, EveryHalfIsReadExactly) {
    std::vector<std::uint16_t> halves(65536);
    for (std::size_t i = 0; i < halves.size(); ++i)
        halves[i] = static_cast<std::uint16_t>(i);
    WeightMatrix one(3, 1);
    for (std::size_t row = 0; row < 3; ++row)
        one.at(row, 0) = 1;
    const std::vector<BandView> views{
        {reinterpret_cast<const std::byte*>(halves.data()), SampleType::Half, 2}};
    std::vector<std::vector<float>> out(3, std::vector<float>(halves.size()));
    const std::vector<float*> pointers{out[0].data(), out[1].data(), out[2].data()};
    collapse_run(views, one, halves.size(), pointers);
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const float expected = float_from_half(halves[i]);
        if (std::isnan(expected))
            EXPECT_TRUE(std::isnan(out[0][i])) << i;
        else
            EXPECT_EQ(out[0][i], expected) << i;  // -0 becomes +0: the sum starts there
    }
}

TEST_P(KernelOn, ABandOfWeightZeroIsNotRead) {
    std::mt19937 random(5);
    Case test(random, 100, 3, 0, {SampleType::Float});
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t band = 0; band < 3; ++band)
            test.weights.at(row, band) = band == 1 ? 0.0 : 0.5;
    test.weights.at(2, 1) = 0.25;  // one output needs it
    for (std::size_t pixel = 0; pixel < 100; ++pixel)
        Case::put(SampleType::Float, test.sample(1, pixel), std::numeric_limits<float>::quiet_NaN());
    const auto out = test.run(collapse_run);
    EXPECT_TRUE(std::isfinite(out[0][50]) && std::isfinite(out[1][50]));
    EXPECT_TRUE(std::isnan(out[2][50]));
    expect_same_bits(out, test.run(collapse_run_reference));

    test.weights.at(2, 1) = 0;
    test.views[1] = {};  // nobody needs it: nothing may be there
    EXPECT_TRUE(std::isfinite(test.run(collapse_run)[2][99]));
}

TEST_P(KernelOn, StridedSamplesAreTheSame) {
    std::mt19937 random(6);
    Case test(random, 300, 4, 0, {SampleType::Float});
    for (BandView& view : test.views)
        view.pixel_stride_bytes *= 3;
    const Case strided = [&] {
        Case copy(random, 100, 4, 0, {SampleType::Float});
        copy.views = test.views;
        copy.weights = test.weights;
        return copy;
    }();
    expect_same_bits(strided.run(collapse_run), strided.run(collapse_run_reference));
}

/// One output is a luminance, twelve are four lights at once.
TEST_P(KernelOn, AnyNumberOfOutputsIsTheSame) {
    std::mt19937 random(7);
    for (std::size_t rows = 1; rows <= 14; ++rows)
        for (const std::size_t pixels : {5U, 16U, 31U, 77U, 256U})
            for (const auto& types : kTypes) {
                SCOPED_TRACE(testing::Message() << rows << " outputs, " << pixels << " pixels");
                const Case test(random, pixels, 9, 1, types, rows);
                expect_same_bits(test.run(collapse_run), test.run(collapse_run_reference));
            }
}

/// Samples of a line of mixed types start at any byte.
TEST_P(KernelOn, SamplesNeedNoAlignment) {
    std::mt19937 random(11);
    for (const auto& types : {kTypes[0], kTypes[1], kTypes[2]}) {
        Case test(random, 101, 6, 0, types);
        std::vector<std::vector<std::byte>> moved;
        const Case shifted = [&] {
            Case copy = test;
            for (BandView& view : copy.views) {
                const std::size_t bytes = 101 * sample_bytes(view.type);
                moved.emplace_back(bytes + 1);
                std::memcpy(moved.back().data() + 1, view.data, bytes);
                view.data = moved.back().data() + 1;
            }
            return copy;
        }();
        expect_same_bits(shifted.run(collapse_run), test.run(collapse_run_reference));
    }
}

std::vector<std::int64_t> targets_of_this_machine() {
    std::vector<std::int64_t> out;
    for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
        const std::int64_t target = targets & -targets;
        if (hwy::TargetName(target) != std::string("Unknown"))  // bits that are reserved
            out.push_back(target);
    }
    return out;
}

INSTANTIATE_TEST_SUITE_P(Targets, KernelOn, testing::ValuesIn(targets_of_this_machine()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

TEST(KernelReference, ErrorStaysWithinTheForwardBound) {
    // float(sum in double): half a unit of float, and one unit of double for each product and sum.
    std::mt19937 random(8);
    for (const std::size_t bands : {1U, 31U, 401U}) {
        const Case test(random, 500, bands, 0, {SampleType::Float});
        const auto out = test.run(collapse_run_reference);
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t pixel = 0; pixel < 500; ++pixel) {
                long double exact = 0, absolute = 0;
                for (std::size_t band = 0; band < bands; ++band) {
                    const long double term = static_cast<long double>(test.weights.at(row, band)) *
                                             static_cast<long double>(sample_at(test.views[band], pixel));
                    exact += term;
                    absolute += std::abs(term);
                }
                const auto error = std::abs(static_cast<long double>(out[row][pixel]) - exact);
                EXPECT_LE(error, 0x1p-24L * std::abs(exact) +
                                     static_cast<long double>(bands + 1) * 0x1p-52L * absolute);
            }
    }
}

}  // namespace
}  // namespace osio
