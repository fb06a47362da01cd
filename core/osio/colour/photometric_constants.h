// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The constants that turn watts into lumens, each with its source.
namespace osio {

/// Kcd, lm/W: the luminous efficacy of monochromatic radiation of 540 THz, exact by definition of the
/// candela (SI, 9th edition). It is what luminances here are multiplied by.
inline constexpr double kLuminousEfficacyLmPerW = 683;

/// Km, lm/W: the largest photopic efficacy, Kcd / V(555.016 nm in air), which tables of 2.9e-6 higher
/// luminance use (ISO/CIE 23539:2023). Stated for comparison; 683 is the convention of CIE S 010 too.
inline constexpr double kLargestPhotopicEfficacyLmPerW = 683.002;

/// K'm, lm/W: the largest scotopic efficacy as ISO/CIE 23539:2023 rounds 1700.05.
inline constexpr double kScotopicEfficacyLmPerW = 1700;

}  // namespace osio
