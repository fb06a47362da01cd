// SPDX-License-Identifier: Apache-2.0
#include <osio/collapse/polarisation_stage.h>
#include <osio/colour/polarisation.h>

#include <array>

namespace osio {

namespace {

/// Each component is rounded to a float once, by half of 2^-23 at most: fully polarised light may come out
/// this much above 1.
constexpr double kMostOfFullLight = 1 + 0x1p-21;

}  // namespace

PolarisationCounts polarise(SpaceKind kind, std::span<float* const> components, const float* alpha,
                            std::size_t pixels) {
    const auto index = stokes_components(kind);
    PolarisationCounts counts;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        std::array<double, 4> s{};
        for (std::size_t c = 0; c < components.size(); ++c)
            s[index[c]] = static_cast<double>(components[c][pixel]);
        // A common factor such as alpha leaves degrees and angles as they are.
        const Polarisation result = polarisation_of(kind, {s[0], s[1], s[2], s[3]});
        counts.undefined += result.undefined;
        counts.beyond += kind != SpaceKind::AoLP && result.value > kMostOfFullLight;
        const double share = alpha != nullptr && alpha[pixel] > 0 ? static_cast<double>(alpha[pixel]) : 1;
        components[0][pixel] = static_cast<float>(result.value * share);
    }
    return counts;
}

}  // namespace osio
