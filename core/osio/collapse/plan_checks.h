// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/plan.h>
#include <osio/collapse/request.h>
#include <osio/layout/channel_layout.h>

#include <optional>
#include <string>
#include <vector>

/// What make_plan refuses, and what it warns of.
namespace osio {

/// Usage where the request's words contradict one another.
[[nodiscard]] Result<void> check_request(const CollapseRequest& request);

/// MissingIlluminant for a reflectance without a light; UnexpectedIlluminant for a radiance with one, or
/// Usage for a reflectance in photometric units.
[[nodiscard]] Result<void> check_quantity(const SpectralSet& set, const CollapseRequest& request);

/// Usage where an observer does not give the numbers of a space.
[[nodiscard]] Result<void> check_observer(const Observer& observer, const OutputSpace& space);

/// InvalidGrid or BandsOutsideObserver where the distinct wavelengths define no curve that is seen.
[[nodiscard]] Result<void> check_grid(const SpectralSet& set, const std::vector<double>& wavelengths_nm);

/// InvalidGrid for one wavelength without a width under Extrapolation::Zero: its curve has no area. A
/// bin whose edges the file states has a width.
[[nodiscard]] Result<void> check_width(const CollapsePlan& plan);

/// InvalidGrid where a light has no power between the bands, which say something of first to last nm:
/// every weight would rest on extrapolation. One wavelength says the same of all and is not refused, nor is
/// a fluorescent set, which light from elsewhere excites.
/// `power`: of the light, its filters included, at 1 nm.
[[nodiscard]] Result<void> check_light(const CollapsePlan& plan, const NmSamples& power, double first_nm,
                                       double last_nm);

/// What a user should know of the weight beyond the bands, which say something of first to last nm.
[[nodiscard]] std::optional<std::string> extrapolation_warning(const CollapsePlan& plan, double first_nm,
                                                               double last_nm);

}  // namespace osio
