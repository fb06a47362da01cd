// SPDX-License-Identifier: Apache-2.0
#include <osio/colour/polarisation.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace osio {

namespace {

Polarisation degree(double polarised, double s0) {
    if (s0 > 0 || std::isnan(s0))
        return {polarised / s0, false};
    if (s0 == 0 && polarised == 0)
        return {0, true};
    return {std::numeric_limits<double>::quiet_NaN(), false};
}

Polarisation angle(double s1, double s2) {
    if (s1 == 0 && s2 == 0)
        return {0, true};
    const double degrees = std::atan2(s2, s1) / 2 * (180 / std::numbers::pi);
    return {degrees <= -90 ? 90 : degrees,
            false};  // -180 and 180 degrees are one direction; so are their halves
}

}  // namespace

std::vector<std::size_t> stokes_components(SpaceKind kind) {
    switch (kind) {
    case SpaceKind::S0: return {0};
    case SpaceKind::S1: return {1};
    case SpaceKind::S2: return {2};
    case SpaceKind::S3: return {3};
    case SpaceKind::DoP: return {0, 1, 2, 3};
    case SpaceKind::DoLP: return {0, 1, 2};
    case SpaceKind::DoCP: return {0, 3};
    case SpaceKind::AoLP: return {1, 2};
    default: return {};
    }
}

Polarisation polarisation_of(SpaceKind kind, const StokesVector& s) {
    switch (kind) {
    case SpaceKind::DoP: return degree(std::hypot(s.s1, s.s2, s.s3), s.s0);
    case SpaceKind::DoLP: return degree(std::hypot(s.s1, s.s2), s.s0);
    case SpaceKind::DoCP: return degree(std::abs(s.s3), s.s0);
    default: return angle(s.s1, s.s2);
    }
}

}  // namespace osio
