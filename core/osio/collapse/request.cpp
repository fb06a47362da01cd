// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/request.h>
#include <osio/colour/observer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace osio {

namespace {

/// 2^100 exceeds the ratio of any two lights; beyond it a typing error is likelier than a wish.
constexpr double kMostStops = 100;

constexpr std::string_view kRaw = "raw";

constexpr auto kOptions = std::to_array<RequestOption>({
    {"to", "SPACE",
     "space to collapse to (list spaces; rgb:xr,yr,xg,yg,xb,yb,xw,yw; a space, role or DISPLAY/VIEW of the "
     "OCIO config, ocio:NAME where we have the name too); raw: the bands themselves"},
    {"config", "FILE.ocio",
     "OCIO config that names beyond ours are looked up in; default: the environment's OCIO"},
    {"illuminant", "NAME|FILE.csv", "light on a reflectance, or several between commas (list illuminants)"},
    {"filter", "FILE.csv", "transmittance in front of the light; repeatable"},
    {"filter-normalise", "", "make the diffuser behind the filters Y = 1, instead of darker"},
    {"observer", "NAME|FILE.csv", "observer (list observers) or a camera's sensitivities; default cie1931"},
    {"display", "FILE.csv", "emission curves of the display of to=display"},
    {"part", "N|NAME", "part of a multi-part file, counted from 0"},
    {"set", "[ROOT.]S0..S3|T", "which bands, where a part holds several sets"},
    {"wavelengths", "START:STEP:END|FILE.csv",
     "wavelengths of the channels, in nm: 400:10:700, or lines channel,nm[,fwhm]"},
    {"quantity", "reflectance|radiance", "what the bands hold, where the file does not say"},
    {"basis", "NAME", "how bands become a spectrum (list bases); default auto"},
    {"extrapolate", "hold|zero", "the spectrum beyond the end bands; default hold"},
    {"white", "NAME|x,y", "white to adapt from; default: the light's own, D65 for radiance"},
    {"adapt", "NAME", "none, xyz-scaling, von-kries, bradford (default), cat02 or cat16"},
    {"scale", "relative|photometric|integral", "unit of the result; default relative"},
    {"exposure", "STOPS", "multiplies the result by 2^STOPS"},
    {"names", "rgb|xyz", "channel names of the result; in raw mode: layout keeps the file's"},
    {"max-delta-e", "DE", "no image unless no pixel can be wrong by more than this CIEDE2000"},
    {"white-luminance", "Y",
     "of max-delta-e and certificates: Y of the white; default 1, of radiance the 99th percentile"},
});

/// A choice among words.
template <class Value, std::size_t N>
struct Words {
    std::array<std::pair<std::string_view, Value>, N> words;

    [[nodiscard]] Result<Value> parse(std::string_view key, std::string_view text) const {
        std::vector<std::string> known;
        for (const auto& [word, value] : words) {
            if (iequals(word, text))
                return value;
            known.emplace_back(word);
        }
        return fail(ErrorCode::UnknownName,
                    std::string(key) + " \"" + std::string(text) + "\" is unknown" + suggestion(text, known));
    }

    [[nodiscard]] std::string_view name(Value value) const {
        for (const auto& [word, known] : words)
            if (known == value)
                return word;
        return {};
    }
};

constexpr std::array<BasisInfo, 7> kBases{{
    {Basis::Auto, "auto", "what the file says, else what quantity, sensitivities and spacing suggest"},
    {Basis::Linear, "linear", "samples joined by straight lines, summed at 1 nm"},
    {Basis::Sprague, "sprague",
     "samples joined by Sprague's quintics (CIE 167:2005); equal steps, 6 bands or more"},
    {Basis::E2022, "e2022", "samples joined by cubics, parabolas at the ends (ASTM E2022); 3 bands or more"},
    {Basis::Bins, "bins", "averages over bins, constant in each"},
    {Basis::BinsCorrected, "bins-corrected",
     "averages over bins with the slope that neighbours tell; equal steps, 3 bands or more"},
    {Basis::Response, "response",
     "averages under the file's own sensitivities or widths, smoothest curve through them"},
}};
constexpr Words<Scale, 3> kScales{
    {{{"relative", Scale::Relative}, {"photometric", Scale::Photometric}, {"integral", Scale::Integral}}}};
constexpr Words<Quantity, 2> kQuantities{
    {{{"reflectance", Quantity::Reflectance}, {"radiance", Quantity::Radiance}}}};
constexpr Words<bool, 2> kSwitch{{{{"1", true}, {"0", false}}}};
constexpr Words<Extrapolation, 2> kExtrapolations{
    {{{"hold", Extrapolation::Hold}, {"zero", Extrapolation::Zero}}}};
constexpr Words<OutputNames, 3> kNames{
    {{{"rgb", OutputNames::Rgb}, {"xyz", OutputNames::Xyz}, {"layout", OutputNames::Layout}}}};

Result<void> set_to(CollapseRequest& request, std::string_view value) {
    request.to.reset();
    request.config_space.clear();
    if (iequals(value, kRaw))
        return {};
    auto space = find_output_space(value);
    if (space)
        request.to = std::move(*space);
    else if (space.error().code == ErrorCode::UnknownName && !value.empty())
        request.config_space = value;
    else
        return tl::unexpected(std::move(space).error());
    return {};
}

Result<void> set_exposure(CollapseRequest& request, std::string_view value) {
    const auto stops = parse_double(value);
    if (!stops || std::abs(*stops) > kMostStops)
        return fail(ErrorCode::Usage,
                    "exposure \"" + std::string(value) + "\" is no number of stops between -100 and 100");
    request.exposure_stops = *stops;
    return {};
}

Result<double> parse_positive(std::string_view key, std::string_view value) {
    const auto number = parse_double(value);
    if (!number || *number <= 0)
        return fail(ErrorCode::Usage,
                    std::string(key) + " \"" + std::string(value) + "\" is no number above 0");
    return *number;
}

Result<void> set_observer(CollapseRequest& request, std::string_view value) {
    if (is_table_path(value)) {
        request.observer = value;
        return {};
    }
    OSIO_TRY(const Observer observer, find_observer(value));
    request.observer = observer.id;
    return {};
}

Result<void> set_basis(CollapseRequest& request, std::string_view value) {
    std::vector<std::string> known;
    for (const BasisInfo& info : kBases)
        known.emplace_back(info.name);
    const auto basis = find_basis(value);
    if (!basis)
        return fail(ErrorCode::UnknownName,
                    "no basis is called \"" + std::string(value) + "\"" + suggestion(value, known));
    request.basis = *basis;
    return {};
}

void add_filters(CollapseRequest& request, std::string_view value) {
    for (const std::string_view path : split(value, ','))
        if (!trim(path).empty())
            request.filters.emplace_back(trim(path));
}

}  // namespace

std::span<const RequestOption> request_options() {
    return kOptions;
}

Result<void> set_option(CollapseRequest& request, std::string_view key, std::string_view text) {
    const std::string_view value = trim(text);
    if (key == "to")
        return set_to(request, value);
    if (key == "observer")
        return set_observer(request, value);
    if (key == "exposure")
        return set_exposure(request, value);
    if (key == "basis")
        return set_basis(request, value);
    if (key == "filter") {
        add_filters(request, value);
    } else if (key == "filter-normalise") {
        OSIO_TRY(request.filter_normalise, kSwitch.parse(key, value));
    } else if (key == "scale") {
        OSIO_TRY(request.scale, kScales.parse(key, value));
    } else if (key == "display") {
        request.display = value;
    } else if (key == "extrapolate") {
        OSIO_TRY(request.extrapolation, kExtrapolations.parse(key, value));
    } else if (key == "names") {
        OSIO_TRY(request.names, kNames.parse(key, value));
    } else if (key == "adapt") {
        OSIO_TRY(request.adaptation, find_adaptation(value));
    } else if (key == "illuminant") {
        request.illuminant = value;
    } else if (key == "config") {
        request.config = value;
    } else if (key == "max-delta-e") {
        OSIO_TRY(request.max_delta_e, parse_positive(key, value));
    } else if (key == "white-luminance") {
        OSIO_TRY(request.white_luminance, parse_positive(key, value));
    } else if (key == "part") {
        request.part = value;
    } else if (key == "set") {
        request.set = value;
    } else if (key == "wavelengths") {
        request.wavelengths = value;
    } else if (key == "quantity") {
        OSIO_TRY(request.quantity, kQuantities.parse(key, value));
    } else if (key == "white") {
        request.white = value;
    } else {
        std::vector<std::string> known;
        for (const RequestOption& option : kOptions)
            known.emplace_back(option.key);
        return fail(ErrorCode::UnknownName,
                    "no option is called \"" + std::string(key) + "\"" + suggestion(key, known));
    }
    return {};
}

std::string recipe_text(const CollapseRequest& request) {
    std::string out = "to=" + (request.to                     ? request.to->id
                               : request.config_space.empty() ? std::string(kRaw)
                                                              : request.config_space);
    const auto add = [&out](std::string_view key, std::string_view value) {
        if (!value.empty())
            out += "&" + std::string(key) + "=" + std::string(value);
    };
    if (!request.to || request.to->transform)
        add("config", request.config);
    add("illuminant", request.illuminant);
    add("filter", join(request.filters, ","));
    if (request.filter_normalise)
        add("filter-normalise", "1");
    add("observer", request.observer);
    add("display", request.display);
    add("part", request.part);
    add("set", request.set);
    add("wavelengths", request.wavelengths);
    if (request.quantity)
        add("quantity", quantity_name(*request.quantity));
    add("basis", basis_name(request.basis));
    add("extrapolate", extrapolation_name(request.extrapolation));
    add("white", request.white);
    add("scale", scale_name(request.scale));
    add("adapt", adaptation_name(request.adaptation));
    add("exposure", format_double(request.exposure_stops));
    add("names", kNames.name(request.names));
    if (request.max_delta_e)
        add("max-delta-e", format_double(*request.max_delta_e));
    if (request.white_luminance)
        add("white-luminance", format_double(*request.white_luminance));
    return out;
}

std::span<const BasisInfo> bases() {
    return kBases;
}

std::string_view basis_name(Basis basis) {
    for (const BasisInfo& info : kBases)
        if (info.basis == basis)
            return info.name;
    return {};
}

std::optional<Basis> find_basis(std::string_view name) {
    for (const BasisInfo& info : kBases)
        if (iequals(info.name, name))
            return info.basis;
    return std::nullopt;
}

Result<std::vector<CollapseRequest>> requests_by_light(const CollapseRequest& request) {
    std::vector<CollapseRequest> out;
    for (const std::string_view light : split(request.illuminant, ',')) {
        CollapseRequest one = request;
        one.illuminant = trim(light);
        if (one.illuminant.empty() && !request.illuminant.empty())
            return fail(ErrorCode::Usage, "illuminant \"" + request.illuminant +
                                              "\" names nothing between two commas or at an end; expected "
                                              "names between commas, such as A,D65,FL11");
        out.push_back(std::move(one));
    }
    return out;
}

std::string_view scale_name(Scale scale) {
    return kScales.name(scale);
}

std::string_view extrapolation_name(Extrapolation extrapolation) {
    return kExtrapolations.name(extrapolation);
}

bool takes_tables(std::string_view key) {
    constexpr std::array<std::string_view, 6> kKeys{"illuminant", "filter", "observer",
                                                    "display",    "white",  "wavelengths"};
    return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

bool is_table_path(std::string_view name) {
    return name.find('/') != std::string_view::npos || to_lower(name).ends_with(".csv");
}

}  // namespace osio
