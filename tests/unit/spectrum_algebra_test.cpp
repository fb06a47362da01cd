// SPDX-License-Identifier: Apache-2.0
#include <osio/spectra/spectrum_algebra.h>

#include <support/bound.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace osio::test {
namespace {

class SpectrumAlgebra : public ::testing::Test {
  protected:
    Spectrum random_spectrum(double low = -2, double high = 2) {
        std::uniform_real_distribution<double> value(low, high);
        Spectrum out;
        for (double nm = 380; nm <= 780; nm += 25) {
            out.wavelengths_nm.push_back(nm);
            out.values.push_back(value(m_random));
        }
        return out;
    }

    Spectrum constant(double value) {
        Spectrum out = random_spectrum();
        std::fill(out.values.begin(), out.values.end(), value);
        return out;
    }

    std::mt19937 m_random{7};
};

void expect_near(const Spectrum& a, const Spectrum& b, double tolerance) {
    ASSERT_EQ(a.wavelengths_nm, b.wavelengths_nm);
    for (std::size_t i = 0; i < a.values.size(); ++i)
        EXPECT_NEAR(a.values[i], b.values[i], tolerance) << i;
}

TEST_F(SpectrumAlgebra, SumsAndProductsCommuteAssociateAndDistribute) {
    for (int i = 0; i < 50; ++i) {
        const Spectrum a = random_spectrum(), b = random_spectrum(), c = random_spectrum();
        EXPECT_EQ(sum(a, b)->values, sum(b, a)->values);
        EXPECT_EQ(product(a, b)->values, product(b, a)->values);
        expect_near(*sum(*sum(a, b), c), *sum(a, *sum(b, c)), 1e-14);
        expect_near(*product(*product(a, b), c), *product(a, *product(b, c)), 1e-14);
        expect_near(*product(a, *sum(b, c)), *sum(*product(a, b), *product(a, c)), 1e-14);
        EXPECT_EQ(product(a, constant(1))->values, a.values);
        EXPECT_EQ(sum(a, constant(0))->values, a.values);
        EXPECT_TRUE(is_black(*difference(a, a)));
        EXPECT_TRUE(is_black(*product(a, constant(0))));
        expect_near(*product(*quotient(a, b), b), a, 1e-14);
        expect_near(scaled(*sum(a, b), 3), *sum(scaled(a, 3), scaled(b, 3)), 1e-14);
        EXPECT_EQ(scaled(a, 2).values, sum(a, a)->values);
    }
}

TEST_F(SpectrumAlgebra, RootsPowersAndExponentialsUndoEachOther) {
    for (int i = 0; i < 50; ++i) {
        const Spectrum a = random_spectrum(0.01, 2), b = random_spectrum(), c = random_spectrum();
        expect_near(*product(square_root(a), square_root(a)), a, 1e-15);
        expect_near(power(a, 0.5), square_root(a), 1e-15);
        expect_near(power(power(a, 3), 1.0 / 3), a, 1e-14);
        EXPECT_EQ(power(a, 1).values, a.values);
        EXPECT_EQ(power(b, 0).values, constant(1).values);
        expect_near(exponential(*sum(b, c)), *product(exponential(b), exponential(c)), 1e-13);
    }
    EXPECT_TRUE(has_nan(square_root(constant(-1))));
    EXPECT_FALSE(has_nan(square_root(constant(0))));
}

TEST_F(SpectrumAlgebra, LerpAndClampStayBetweenTheirEnds) {
    for (int i = 0; i < 50; ++i) {
        const Spectrum a = random_spectrum(), b = random_spectrum();
        EXPECT_EQ(lerp(0, a, b)->values, a.values);
        EXPECT_EQ(lerp(1, a, b)->values, b.values);
        expect_near(*lerp(0.3, a, b), *lerp(0.7, b, a), 1e-15);
        expect_near(*lerp(0.3, a, a), a, 1e-15);
        const Spectrum once = clamped(a, -0.5, 0.75);
        EXPECT_EQ(clamped(once, -0.5, 0.75).values, once.values);
        for (std::size_t k = 0; k < once.values.size(); ++k) {
            EXPECT_GE(once.values[k], -0.5);
            EXPECT_LE(once.values[k], 0.75);
            if (a.values[k] >= -0.5 && a.values[k] <= 0.75) {
                EXPECT_EQ(once.values[k], a.values[k]);
            }
        }
    }
    EXPECT_TRUE(has_nan(clamped(constant(std::nan("")), 0, 1)));
}

TEST_F(SpectrumAlgebra, BlackIsZeroEverywhere) {
    EXPECT_TRUE(is_black(constant(0)));
    EXPECT_TRUE(is_black(Spectrum{}));
    Spectrum almost = constant(0);
    almost.values.back() = 1e-300;
    EXPECT_FALSE(is_black(almost));
    almost.values.back() = std::nan("");
    EXPECT_FALSE(is_black(almost));
}

TEST_F(SpectrumAlgebra, OtherGridsAreRefusedAndResamplingBringsThemTogether) {
    Spectrum a = random_spectrum(), b = random_spectrum();
    b.wavelengths_nm[3] += 0.5;
    const auto refused = sum(a, b);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidGrid);
    EXPECT_NE(refused.error().text().find("455 nm where the other has 455.5 nm"), std::string::npos)
        << refused.error().text();
    EXPECT_TRUE(sum(a, resampled(b, a.wavelengths_nm, EdgeRule::Zero)));
    EXPECT_EQ(resampled(a, a.wavelengths_nm, EdgeRule::Hold).values, a.values);
    const std::vector<double> beyond{300, 900};
    EXPECT_EQ(resampled(a, beyond, EdgeRule::Zero).values, (std::vector<double>{0, 0}));
    EXPECT_EQ(resampled(a, beyond, EdgeRule::Hold).values,
              (std::vector<double>{a.values.front(), a.values.back()}));
    b.values.pop_back();
    b.wavelengths_nm.pop_back();
    EXPECT_FALSE(product(a, b));
}

/// The mean by very many midpoints of straight lines found by a linear search.
double average_by_midpoints(const std::vector<double>& nm, const std::vector<double>& values, double low,
                            double high, EdgeRule edge) {
    constexpr int kPoints = 200000;
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double at = low + (high - low) * (i + 0.5) / kPoints;
        std::size_t below = nm.size(), above = nm.size();
        for (std::size_t k = 0; k < nm.size(); ++k) {
            if (nm[k] <= at && (below == nm.size() || nm[k] > nm[below]))
                below = k;
            if (nm[k] >= at && (above == nm.size() || nm[k] < nm[above]))
                above = k;
        }
        if (below == nm.size() || above == nm.size()) {
            if (edge == EdgeRule::Hold)
                sum += values[below == nm.size() ? above : below];
            continue;
        }
        const double width = nm[above] - nm[below];
        const double t = width > 0 ? (at - nm[below]) / width : 0;
        sum += values[below] + t * (values[above] - values[below]);
    }
    return sum / kPoints;
}

/// Unsorted, irregular samples without equal wavelengths.
struct Samples {
    std::vector<double> nm, values;
};

Samples random_samples(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> nm(400, 700), value(-1, 2);
    Samples out;
    for (std::size_t i = 0; i < count; ++i) {
        out.nm.push_back(nm(random));
        out.values.push_back(value(random));
    }
    return out;
}

TEST_F(SpectrumAlgebra, AveragesAreThoseOfManyMidpoints) {
    Bound bound("average against 200000 midpoints", 2e-5);
    for (const std::size_t count : {1U, 2U, 3U, 20U})
        for (const auto& [low, high] :
             {std::pair(300.0, 800.0), {450.0, 460.0}, {350.0, 500.0}, {710.0, 720.0}})
            for (const EdgeRule edge : {EdgeRule::Hold, EdgeRule::Zero}) {
                const Samples s = random_samples(m_random, count);
                bound.see_absolute(average(s.nm, s.values, low, high, edge).value(),
                                   average_by_midpoints(s.nm, s.values, low, high, edge),
                                   std::to_string(count) + " " + std::to_string(low));
            }
}

TEST_F(SpectrumAlgebra, AveragesKeepConstantsAndIgnoreOrder) {
    for (int i = 0; i < 50; ++i) {
        Samples s = random_samples(m_random, 15);
        s.nm[3] = s.nm[9] = s.nm[12];
        std::vector<std::size_t> order(s.nm.size());
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), m_random);
        Samples mixed;
        for (const std::size_t k : order) {
            mixed.nm.push_back(s.nm[k]);
            mixed.values.push_back(s.values[k]);
        }
        const std::vector<double> flat(s.nm.size(), 0.7);
        for (const EdgeRule edge : {EdgeRule::Hold, EdgeRule::Zero}) {
            EXPECT_EQ(average(s.nm, s.values, 350, 650, edge).value(),
                      average(mixed.nm, mixed.values, 350, 650, edge).value());
            EXPECT_EQ(average(s.nm, s.values, 512, 512, edge).value(),
                      average(mixed.nm, mixed.values, 512, 512, edge).value());
        }
        EXPECT_NEAR(average(s.nm, flat, 300, 900, EdgeRule::Hold).value(), 0.7, 1e-15);
    }
}

TEST_F(SpectrumAlgebra, AveragesAreLinearAdditiveAndBlindToCollinearSamples) {
    for (int i = 0; i < 50; ++i) {
        Samples s = random_samples(m_random, 12);
        const Samples other = random_samples(m_random, 12);
        for (const EdgeRule edge : {EdgeRule::Hold, EdgeRule::Zero}) {
            const auto mean = [&](const std::vector<double>& values, double low, double high) {
                return average(s.nm, values, low, high, edge).value();
            };
            std::vector<double> mix;
            for (std::size_t k = 0; k < s.nm.size(); ++k)
                mix.push_back(2 * s.values[k] - 3 * other.values[k]);
            EXPECT_NEAR(mean(mix, 380, 690), 2 * mean(s.values, 380, 690) - 3 * mean(other.values, 380, 690),
                        1e-13);
            EXPECT_NEAR(400 * mean(s.values, 350, 750),
                        150 * mean(s.values, 350, 500) + 250 * mean(s.values, 500, 750), 1e-10);
            Samples more = s;
            const auto [first, last] = std::minmax_element(s.nm.begin(), s.nm.end());
            const double nm = (*first + *last) / 2;
            more.nm.push_back(nm);
            more.values.push_back(mean(s.values, nm, nm));
            EXPECT_NEAR(average(more.nm, more.values, 350, 750, edge).value(), mean(s.values, 350, 750),
                        1e-14);
        }
    }
}

TEST_F(SpectrumAlgebra, AveragesSurviveLargeValuesAndRefuseNonsense) {
    const std::vector<double> nm{400, 700}, large{1e308, 1e308}, one{1};
    EXPECT_NEAR(average(nm, large, 300, 800, EdgeRule::Hold).value() / 1e308, 1, 1e-15);
    EXPECT_EQ(average(one, one, 300, 800, EdgeRule::Zero).value(), 0);
    for (const auto& bad : {average({}, {}, 1, 2, EdgeRule::Hold), average(nm, one, 1, 2, EdgeRule::Hold),
                            average(nm, large, 2, 1, EdgeRule::Hold),
                            average(std::vector<double>{std::nan("")}, one, 1, 2, EdgeRule::Hold)}) {
        ASSERT_FALSE(bad);
        EXPECT_EQ(bad.error().code, ErrorCode::Usage);
    }
}

}  // namespace
}  // namespace osio::test
