// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/matrix3.h>
#include <osio/base/result.h>
#include <osio/colour/filter.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/observer.h>
#include <osio/layout/channel_layout.h>
#include <osio/spectra/band_integrals.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// Fluorescence: what a set's pairs `T.in.out` add to a colour.
namespace osio {

/// Light that excites: power at 200, 201, ..., 830 nm, behind its filters.
struct ExcitingLight {
    std::vector<double> power;
    double first_nm = 0;  ///< what the light's table speaks of; beyond it there is none
    double last_nm = 0;
};

[[nodiscard]] ExcitingLight exciting_light(const Illuminant& light, std::span<const Filter> filters);

/// What the pairs of one set weigh before the observer's integrals become outputs.
struct ReradiationWeights {
    /// For each pair of the set the mean of the light over the exciting band times the integrals of the
    /// observer's three curves over the emitting band, in the units of light x curve x nm.
    std::vector<Vector3> integrals;
    /// Share of all weight that bands beyond the light's table would have if it kept its end values.
    double unlit_share = 0;
    std::vector<double> excited_nm, emitted_nm;  ///< distinct wavelengths, increasing
    std::vector<std::string> warnings;
};

/// A pair's sample M is an element of the Donaldson matrix (ASTM E2152, E2153) for the file's own bands: with
/// light L the surface sends out M(in, out) times the mean of L over the band `in`, as spectral radiance at
/// `out`, in addition to what it reflects there. So no sample is a density per nanometre, and the sum over
/// `out` at equal steps is the share of the exciting power that comes out again.
///
/// Between its samples the emission is a straight line, and falls to zero one step beyond the outermost; a
/// band's light is weighed by the same triangle. With a basis of bins both are boxes: the edges that the
/// file states for that wavelength, else midpoints. Nothing is extrapolated. A band whose wavelength lies
/// beyond the light's table gets no light, with a warning; one partly beyond it the mean of the rest. A
/// filter keeps its end values, with a warning. Pairs of the same two wavelengths share their weight.
///
/// `bands` are the set's own. InvalidGrid for one exciting and one emitted wavelength of a set with one
/// band, which have no width.
[[nodiscard]] Result<ReradiationWeights> reradiation_weights(const SpectralSet& set, Basis basis,
                                                             const BandGrid& bands, const Illuminant& light,
                                                             std::span<const Filter> filters,
                                                             const Observer& observer);

}  // namespace osio
