// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/plan_checks.h>

#include <algorithm>
#include <cmath>

namespace osio {

namespace {

/// A share of extrapolated weight above this is worth a warning.
constexpr double kExtrapolationWarning = 0.05;

tl::unexpected<Error> usage(std::string what) {
    return fail(ErrorCode::Usage, std::move(what));
}

Result<void> check_names(const CollapseRequest& request) {
    const std::string space(request.to->id);
    if (request.names == OutputNames::Layout)
        return usage("names=layout is for bands; with to=" + space + " use rgb or xyz");
    const SpaceKind kind = request.to->kind;
    if (request.names == OutputNames::Xyz && request.to->transform)
        return usage("names=xyz does not fit to=" + space + ", whose values are those of a colour config");
    if (request.names == OutputNames::Xyz && (is_rgb(kind) || is_polarimetric(kind) || !is_tristimulus(kind)))
        return usage("names=xyz does not fit to=" + space + ", whose values are " +
                     (is_rgb(kind) ? "red, green and blue" : join(space_outputs(kind), ", ")));
    if (request.adaptation != CollapseRequest{}.adaptation && !is_adapted(kind))
        return usage("adapt=" + std::string(adaptation_name(request.adaptation)) +
                     " does not fit to=" + space + ", which is not adapted");
    if (request.names == OutputNames::Rgb && is_single(kind))
        return usage("names=rgb does not fit to=" + space + ", which is one channel, " +
                     space_outputs(kind).front());
    return {};
}

}  // namespace

Result<void> check_request(const CollapseRequest& request) {
    if (!request.config_space.empty())
        return tl::unexpected(find_output_space(request.config_space).error());
    if (!request.to)
        return usage("no space to collapse to was named; use to=" + join(output_space_names(), ", to="));
    OSIO_CHECK_OK(check_names(request));
    const SpaceKind kind = request.to->kind;
    if (!request.white.empty() && !has_white(kind))
        return usage("white=" + request.white + " does not fit to=" + std::string(request.to->id) +
                     ", which is not adapted" + (kind == SpaceKind::Xyz ? "; use to=xyz_d65" : ""));
    if ((kind == SpaceKind::Display) != !request.display.empty())
        return usage("to=display and display=FILE.csv go together: the table holds what the display emits");
    if (request.filter_normalise && request.filters.empty())
        return usage("filter-normalise was given without a filter");
    if (request.scale == Scale::Photometric && kind == SpaceKind::Camera)
        return usage("scale=photometric does not fit to=camera: a camera is no luminous observer");
    return {};
}

Result<void> check_quantity(const SpectralSet& set, const CollapseRequest& request) {
    if (set.quantity() == Quantity::Reflectance && request.illuminant.empty())
        return fail(ErrorCode::MissingIlluminant,
                    "set " + set.name() +
                        " is a reflectance, which has no colour without a light; name one with "
                        "illuminant=D65 (osiotool list illuminants)");
    if (request.illuminant.find(',') != std::string::npos)
        return fail(ErrorCode::Usage, "found several lights, illuminant=" + request.illuminant +
                                          ", where one is expected; only collapse, plan and open files take "
                                          "more");
    if (set.quantity() == Quantity::Radiance && !request.illuminant.empty())
        return fail(ErrorCode::UnexpectedIlluminant,
                    "set " + set.name() +
                        " is a radiance, which already holds its light; leave "
                        "illuminant=" +
                        request.illuminant + " out");
    if (set.quantity() == Quantity::Reflectance && request.scale == Scale::Photometric)
        return usage(
            "scale=photometric is for radiance; the illuminants of a reflectance have relative power");
    return {};
}

Result<void> check_observer(const Observer& observer, const OutputSpace& space) {
    const std::string observed = "observer=" + observer.id, to = "to=" + std::string(space.id);
    if (observer.kind == ObserverKind::Luminous && !is_single(space.kind))
        return usage(observed + " has one curve and no colour; with it use to=luminance, not " + to);
    if (observer.kind == ObserverKind::Camera && space.kind != SpaceKind::Camera)
        return usage(observed +
                     " is a camera, whose red, green and blue are its own; with it use to=camera, not " + to);
    if (observer.kind != ObserverKind::Camera && space.kind == SpaceKind::Camera)
        return usage("to=camera needs a camera: observer=FILE.csv with columns nm,R,G,B, not " + observed);
    return {};
}

Result<void> check_grid(const SpectralSet& set, const std::vector<double>& nm) {
    if (nm.empty())
        return fail(
            ErrorCode::InvalidGrid,
            "set " + set.name() + " holds no band" +
                (set.reradiation.empty()
                     ? std::string()
                     : ", only " + std::to_string(set.reradiation.size()) +
                           " pairs of reradiation: what it reflects without fluorescence is missing"));
    const std::string range = format_double(nm.front()) + "-" + format_double(nm.back()) + " nm";
    if (nm.front() > kObserverLastNm || nm.back() < kObserverFirstNm)
        return fail(ErrorCode::BandsOutsideObserver, "the bands of set " + set.name() + " cover " + range +
                                                         ", nothing of the 360-830 nm that an observer sees");
    return {};
}

Result<void> check_width(const CollapsePlan& plan) {
    const BandGrid& grid = plan.distinct.grid;
    const bool has_width = grid.size() > 1 || (is_binned(plan.basis.basis) && !grid.edges_nm.empty());
    if (has_width || plan.request.extrapolation == Extrapolation::Hold)
        return {};
    return fail(ErrorCode::InvalidGrid, "set " + plan.request.set + " has one wavelength, " +
                                            format_double(grid.wavelengths_nm.front()) +
                                            " nm: with extrapolate=zero its spectrum has no width; "
                                            "use extrapolate=hold");
}

Result<void> check_light(const CollapsePlan& plan, const NmSamples& power, double first_nm, double last_nm) {
    if (!plan.illuminant || plan.distinct.grid.size() == 1 || plan.columns.size() > plan.bands.size())
        return {};
    for (std::size_t i = 0; i < power.size(); ++i) {
        const double nm = kObserverFirstNm + static_cast<double>(i);
        // A light that ends at the next whole nanometre reaches in between by its straight line.
        if (power[i] > 0 && nm > first_nm - 1 && nm < last_nm + 1)
            return {};
    }
    return fail(ErrorCode::InvalidGrid,
                "the light has no power over " + format_double(first_nm) + "-" + format_double(last_nm) +
                    " nm, which is what the bands of set " + plan.request.set +
                    " say something of: all of the result would be extrapolated; use another light, or bands "
                    "where it shines",
                plan.illuminant->id);
}

std::optional<std::string> extrapolation_warning(const CollapsePlan& plan, double first_nm, double last_nm) {
    const double below_nm = std::max(0.0, first_nm - kObserverFirstNm);
    const double above_nm = std::max(0.0, kObserverLastNm - last_nm);
    if (below_nm + above_nm <= 0)
        return std::nullopt;
    const auto& share = plan.extrapolated_share;
    const double largest = *std::max_element(share.begin(), share.end());
    std::string text = format_double(below_nm) + " nm below and " + format_double(above_nm) +
                       " nm above the bands are extrapolated (" +
                       std::string(extrapolation_name(plan.request.extrapolation)) + "): ";
    if (largest == 0) {
        text += "no output has weight there";
    } else if (largest <= kExtrapolationWarning) {
        text += "at most " + format_fixed(std::ceil(1e4 * largest) / 100, 2) + " % of an output's weight";
    } else {
        text += "much of the weight rests on it,";
        for (std::size_t row = 0; row < share.size(); ++row)
            text += " " + plan.weighed()[row] + " " + format_fixed(100 * share[row], 1) + " %";
    }
    return text;
}

}  // namespace osio
