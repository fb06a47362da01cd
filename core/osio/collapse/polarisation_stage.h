// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/colour/rgb_space.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace osio {

/// What the way from Stokes components to a degree or an angle met.
struct PolarisationCounts {
    std::uint64_t undefined = 0;  ///< pixels without light that could have one: written as 0
    std::uint64_t beyond = 0;     ///< pixels with a degree above 1
};

/// Turns the components of stokes_components(kind), a plane each, into the degree or angle of `kind`, in the
/// first plane. Where `alpha` is not null the components are associated with it, and the result is again,
/// as any colour of a collapse is.
PolarisationCounts polarise(SpaceKind kind, std::span<float* const> components, const float* alpha,
                            std::size_t pixels);

}  // namespace osio
