// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/colour/rgb_space.h>

#include <cstddef>
#include <vector>

/// What a Stokes vector says of light (Goldstein, Polarized Light, 3rd edition, CRC Press 2011).
namespace osio {

/// Intensity S0, linear parts S1 (0 less 90 degrees) and S2 (45 less 135 degrees), circular part S3, whose
/// sign follows the file's polarisationHandedness.
struct StokesVector {
    double s0 = 0;
    double s1 = 0;
    double s2 = 0;
    double s3 = 0;
};

/// The components that a polarimetric space needs, as indices 0 to 3: those of S1 are {1}, of DoLP {0, 1, 2}.
/// Empty for other kinds.
[[nodiscard]] std::vector<std::size_t> stokes_components(SpaceKind kind);

/// A degree or an angle.
struct Polarisation {
    double value = 0;
    bool undefined = false;  ///< no light to have a degree, or none that is polarised to have an angle: 0
};

/// DoP = sqrt(S1^2 + S2^2 + S3^2) / S0, DoLP = sqrt(S1^2 + S2^2) / S0, DoCP = |S3| / S0, and
/// AoLP = atan2(S2, S1) / 2 in degrees, above -90 and up to 90, from the direction in which S1 is positive.
///
/// Where S0 and the components are all 0 a degree is 0 and undefined, where S1 and S2 are, the angle; so a
/// black background stays black. A degree over S0 below 0, or over 0 with something above it, is NaN: no
/// light is like that. A degree above 1, which noise makes, is kept. `kind`: one of the four.
[[nodiscard]] Polarisation polarisation_of(SpaceKind kind, const StokesVector& stokes);

}  // namespace osio
