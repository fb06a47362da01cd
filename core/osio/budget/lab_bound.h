// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// From an error in tristimulus values to a colour difference that it cannot exceed.
namespace osio {

/// CIEDE2000 (kL = kC = kH = 1) of two colours is at most this times their CIE 1976 difference.
///
/// Derivation. With S_L >= 1, |R_T| <= R_C and 2 |dC dH| <= dC^2 + dH^2, and since dC'^2 + dH'^2 is the square of
/// the distance of (a', b'), where a' = (1 + G) a:
///
///     dE00^2 <= dL^2 + (1 + R_C(c') / 2) (1 + G(c))^2 / S(c')^2 (da^2 + db^2)
///
/// with S = min(S_C, S_H) >= 1 + 0.015 (1 - 0.17 - 0.24 - 0.32 - 0.20) c', c the mean chroma and c' that of
/// the stretched colours, c <= c' <= (1 + G) c. The factor of da^2 + db^2 is largest at c = 16.70, 2.9165, whose root is
/// 1.7078 (`lab_bound_test` evaluates it).
inline constexpr double kDeltaE2000PerDeltaE76 = 1.71;

/// Upper bounds of the slope of the function f of CIE 15:2018, 8.2.1.1 (Lab's cube root and the line below it).
class LabSlope {
  public:
    LabSlope();

    /// Not below f'(s) for every s >= t, and above f'(t) by less than 1.1 %. NaN gives the line's slope.
    [[nodiscard]] float at_and_above(float t) const {
        if (!(t > kFirst))
            return m_slopes[0];
        const float place = t < kLast ? t : kLast;
        return m_slopes[index_of(place)];
    }

  private:
    // Where the line joins the root, (6/29)^3 = 0.00886, lies in the first bucket's binade.
    static constexpr float kFirst = 0x1p-7F, kLast = 0x1p16F;
    static constexpr unsigned kDroppedBits = 17;
    [[nodiscard]] static std::size_t index_of(float t);
    std::array<float, (23U << (23 - kDroppedBits)) + 1> m_slopes{};
};

/// The square of the CIEDE2000 difference that errors in X, Y and Z, as shares of the white's, do not exceed
/// where the slopes of f are at most these: |df| <= slope x error, and L*, a*, b* are linear in f.
[[nodiscard]] inline float squared_delta_e_bound(const std::array<float, 3>& slope,
                                                 const std::array<float, 3>& error) {
    constexpr auto kFactor = static_cast<float>(kDeltaE2000PerDeltaE76 * kDeltaE2000PerDeltaE76);
    const float x = slope[0] * error[0], y = slope[1] * error[1], z = slope[2] * error[2];
    const float l = 116 * y, a = 500 * (x + y), b = 200 * (y + z);
    return kFactor * (l * l + a * a + b * b);
}

}  // namespace osio
