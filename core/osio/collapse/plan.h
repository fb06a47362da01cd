// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/basis_choice.h>
#include <osio/collapse/request.h>
#include <osio/collapse/reradiation.h>
#include <osio/collapse/text_loader.h>
#include <osio/collapse/weights.h>
#include <osio/colour/display.h>
#include <osio/colour/filter.h>
#include <osio/colour/illuminant.h>
#include <osio/colour/observer.h>
#include <osio/layout/channel_layout.h>
#include <osio/layout/spectral_metadata.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace osio {

/// What a column of weights is multiplied by: a channel, and what it holds.
struct PlanColumn {
    std::size_t channel = 0;
    double wavelength_nm = 0;          ///< of a pair that of the exciting light
    std::optional<double> emitted_nm;  ///< of a pair
};

/// A request made ready for one set of bands: one row of weights for each output, everything folded
/// in. A plan is built once and never changed; equal requests on equal bands have equal ids.
struct CollapsePlan {
    CollapseRequest request;  ///< with the set that was chosen
    OutputSpace space;
    std::vector<std::string> outputs;  ///< what comes out: R, G, B; X, Y, Z; Y; L*, a*, b*; ...
    std::vector<Band> bands;           ///< by wavelength
    std::vector<PlanColumn> columns;   ///< the bands, then a fluorescent set's pairs or other components
    WeightMatrix weights;              ///< weighed() x columns, linear; PixelStage has what comes then
    bool has_sign = false;             ///< of S1, S2, S3: below zero is no colour outside a gamut
    Observer observer;
    std::optional<Illuminant> illuminant;
    std::vector<Filter> filters;
    std::optional<Display> display;
    BasisChoice basis;
    DistinctBands distinct;  ///< the bands as the curves that the basis is made of
    Quadrature quadrature = Quadrature::Sum1nm;
    Vector3 white{};                                ///< XYZ of the white that values refer to, Y = 1
    std::optional<Vector3> adapted_from;            ///< XYZ of the white that adaptation starts from, Y = 1
    std::optional<ReradiationWeights> reradiation;  ///< of a fluorescent set
    std::vector<double> extrapolated_share;         ///< for each output, share of weight beyond the bands
    std::vector<std::string> warnings;
    std::string id;

    [[nodiscard]] std::vector<double> wavelengths_nm() const;
    /// What the rows of weights give: the outputs, or X, Y, Z or Stokes components where the outputs are made
    /// of those.
    [[nodiscard]] std::vector<std::string> weighed() const;
    /// How the result's channels are called, by the request's `names`.
    [[nodiscard]] std::vector<std::string> channel_names() const;
};

/// Builds the weights of CIE 15:2018, 7.1 for one set, with the basis that choose_basis decides.
///
/// Reflectance: X = k sum R S x, k = 1 / sum S y over 360-830 nm whatever the bands cover, so that
/// the perfect diffuser has Y = 1. Radiance: divided by sum y, so that flat 1 has Y = 1. Filters multiply
/// S (or stand before the radiance) but not k, unless the request normalises them. Scale::Photometric
/// takes k = 683 lm/W (scotopic: 1700), Scale::Integral k = 1.
///
/// A pair T.in.out of a reflectance has a weight of its own beside the bands', with the same k: see
/// reradiation_weights.
///
/// Spaces with a white are adapted to it, by the request's `adaptation`, from the light's computed white
/// without its filters (radiance: from D65, that is not at all for D65 spaces), or from the request's
/// `white`; a display likewise to its own white, but from it for radiance, whose very colour it then
/// shows. A camera's channels are each divided by their sum over the light, so that the perfect diffuser
/// is (1, 1, 1), unless the scale is Integral. xyz, luminance and camera are not adapted; Lab, Luv and
/// chromaticities refer to that same white, unadapted, and their weights are those of X, Y, Z.
///
/// Refuses, before a pixel is read: a reflectance without an illuminant, a radiance with one, bands
/// wholly outside 360-830 nm, one band with extrapolation zero (a curve of no width) unless its bin's
/// edges are stated, a light without power between the bands, a basis that the bands cannot have, words
/// that contradict one another. What is only doubtful becomes a warning.
[[nodiscard]] Result<CollapsePlan> make_plan(const SpectralSet& set, const SpectralMetadata& metadata,
                                             const CollapseRequest& request, const TextLoader& load_text);

/// The same for `sets[chosen]`, where a polarimetric space takes the components of its root from all of
/// `sets` (see make_stokes_plan).
[[nodiscard]] Result<CollapsePlan> make_plan(std::span<const SpectralSet> sets, std::size_t chosen,
                                             const SpectralMetadata& metadata, const CollapseRequest& request,
                                             const TextLoader& load_text);

/// The same for bands of which no header says anything.
[[nodiscard]] Result<CollapsePlan> make_plan(const SpectralSet& set, const CollapseRequest& request,
                                             const TextLoader& load_text);

}  // namespace osio
