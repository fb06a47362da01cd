// SPDX-License-Identifier: Apache-2.0
#include <osio/base/text.h>
#include <osio/collapse/request.h>
#include <osio/colour/observer.h>

#include <array>
#include <cmath>
#include <vector>

namespace osio {

namespace {

/// 2^100 exceeds the ratio of any two lights; beyond it a typing error is likelier than a wish.
constexpr double kMostStops = 100;

constexpr std::string_view kRaw = "raw";

constexpr std::array<RequestOption, 11> kOptions{{
    {"to", "SPACE",
     "space to collapse to (list spaces; rgb:xr,yr,xg,yg,xb,yb,xw,yw); raw: the bands themselves"},
    {"illuminant", "NAME|FILE.csv", "light on a reflectance (list illuminants)"},
    {"observer", "NAME", "standard observer (list observers); default cie1931"},
    {"part", "N|NAME", "part of a multi-part file, counted from 0"},
    {"set", "[ROOT.]S0..S3|T", "which bands, where a part holds several sets"},
    {"basis", "linear", "how bands become a spectrum; default linear"},
    {"extrapolate", "hold|zero", "the spectrum beyond the end bands; default hold"},
    {"white", "NAME|x,y", "white to adapt from; default: the light's own, D65 for radiance"},
    {"adapt", "NAME", "none, xyz-scaling, von-kries, bradford (default), cat02 or cat16"},
    {"exposure", "STOPS", "multiplies the result by 2^STOPS"},
    {"names", "rgb|xyz", "channel names of the result; in raw mode: layout keeps the file's"},
}};

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

constexpr Words<Basis, 1> kBases{{{{"linear", Basis::Linear}}}};
constexpr Words<Extrapolation, 2> kExtrapolations{
    {{{"hold", Extrapolation::Hold}, {"zero", Extrapolation::Zero}}}};
constexpr Words<OutputNames, 3> kNames{
    {{{"rgb", OutputNames::Rgb}, {"xyz", OutputNames::Xyz}, {"layout", OutputNames::Layout}}}};

Result<void> set_to(CollapseRequest& request, std::string_view value) {
    if (iequals(value, kRaw)) {
        request.to.reset();
        return {};
    }
    OSIO_TRY(request.to, find_output_space(value));
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

Result<void> set_observer(CollapseRequest& request, std::string_view value) {
    OSIO_TRY(const Observer observer, find_observer(value));
    request.observer = observer.id;
    return {};
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
    if (key == "basis") {
        OSIO_TRY(request.basis, kBases.parse(key, value));
    } else if (key == "extrapolate") {
        OSIO_TRY(request.extrapolation, kExtrapolations.parse(key, value));
    } else if (key == "names") {
        OSIO_TRY(request.names, kNames.parse(key, value));
    } else if (key == "adapt") {
        OSIO_TRY(request.adaptation, find_adaptation(value));
    } else if (key == "illuminant") {
        request.illuminant = value;
    } else if (key == "part") {
        request.part = value;
    } else if (key == "set") {
        request.set = value;
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
    std::string out = "to=" + (request.to ? request.to->id : std::string(kRaw));
    const auto add = [&out](std::string_view key, std::string_view value) {
        if (!value.empty())
            out += "&" + std::string(key) + "=" + std::string(value);
    };
    add("illuminant", request.illuminant);
    add("observer", request.observer);
    add("part", request.part);
    add("set", request.set);
    add("basis", basis_name(request.basis));
    add("extrapolate", extrapolation_name(request.extrapolation));
    add("white", request.white);
    add("adapt", adaptation_name(request.adaptation));
    add("exposure", format_double(request.exposure_stops));
    add("names", kNames.name(request.names));
    return out;
}

std::string_view basis_name(Basis basis) {
    return kBases.name(basis);
}

std::string_view extrapolation_name(Extrapolation extrapolation) {
    return kExtrapolations.name(extrapolation);
}

bool is_table_path(std::string_view name) {
    return name.find('/') != std::string_view::npos || to_lower(name).ends_with(".csv");
}

}  // namespace osio
