// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/colour/adaptation.h>
#include <osio/colour/rgb_space.h>
#include <osio/layout/channel_layout.h>
#include <osio/spectra/basis.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osio {

/// How output channels are called.
enum class OutputNames {
    Default,  ///< R, G, B of a collapse; comma-free band names otherwise
    Rgb,      ///< R, G, B
    Xyz,      ///< X, Y, Z; only where the values are tristimulus values
    Layout,   ///< bands by the file's own names; only without a collapse
};

/// What the numbers of a result are multiples of.
enum class Scale {
    Relative,     ///< the perfect diffuser, or a radiance of 1 W/(m2 sr nm) at every wavelength, has Y = 1
    Photometric,  ///< Y of a radiance is its luminance, cd/m2
    Integral,     ///< the plain sum over bands at 1 nm, in the units of the tables times nm
};

/// Every choice of a collapse, defaulted in one place. The same words serve the command line, file
/// queries, recipe files and host hints.
struct CollapseRequest {
    std::optional<OutputSpace> to;  ///< nothing: the bands themselves
    std::string config_space;       ///< a name that is none of ours, until resolve_output() knows it
    std::string config;             ///< path of an OCIO config; empty: the environment's
    std::string illuminant;         ///< a name or the path of a .csv, or several between commas; empty: none
    std::vector<std::string> filters;  ///< paths of .csv, each in front of the light
    bool filter_normalise = false;     ///< the diffuser behind the filters has Y = 1
    std::string observer = "cie1931";  ///< a name, or the path of a camera's .csv
    std::string display;               ///< path of a display's .csv of emission curves
    std::string part;                  ///< index or name; empty: the only one with bands
    std::string set;                   ///< "T", "S0", "left.T"; empty: the only one
    std::string wavelengths;           ///< START:STEP:END or a .csv: see band_map.h; empty: the file's own
    std::optional<Quantity> quantity;  ///< of bands whose file does not say what they hold
    Basis basis = Basis::Auto;
    Extrapolation extrapolation = Extrapolation::Hold;
    std::string white;  ///< an illuminant's name, a .csv or "x,y"; empty: see docs
    Scale scale = Scale::Relative;
    Adaptation adaptation = Adaptation::Bradford;
    double exposure_stops = 0;
    OutputNames names = OutputNames::Default;
    std::optional<double> max_delta_e;      ///< CIEDE2000 that no pixel's certified error may exceed
    std::optional<double> white_luminance;  ///< Y of the white that CIEDE2000 refers to; nothing: see docs
};

/// One option: `key` is the word, `value` what it takes, `help` a line for people.
struct RequestOption {
    std::string_view key;
    std::string_view value;  ///< empty: a switch, whose value is 1
    std::string_view help;
};

/// Every option, in the order in which a recipe spells them.
[[nodiscard]] std::span<const RequestOption> request_options();

/// Sets one option from its text; a name of `to` that is none of ours waits for resolve_output();
/// `filter` adds to what is set, and takes several between commas. Usage
/// or UnknownName says what was found and expected.
[[nodiscard]] Result<void> set_option(CollapseRequest& request, std::string_view key, std::string_view value);

/// The request as `key=value&...`: every choice that matters to the result, defaults included, in a
/// fixed order. Reading it back gives the same request.
[[nodiscard]] std::string recipe_text(const CollapseRequest& request);

/// The requests, one for each light, that a request for several lights means; itself for one or none.
/// Usage for a light without a name.
[[nodiscard]] Result<std::vector<CollapseRequest>> requests_by_light(const CollapseRequest& request);

/// A basis and what it means, for people.
struct BasisInfo {
    Basis basis;
    std::string_view name;
    std::string_view meaning;
};

[[nodiscard]] std::span<const BasisInfo> bases();

/// "linear"; "hold", "zero"; "relative".
[[nodiscard]] std::string_view basis_name(Basis basis);
[[nodiscard]] std::optional<Basis> find_basis(std::string_view name);
[[nodiscard]] std::string_view scale_name(Scale scale);
[[nodiscard]] std::string_view extrapolation_name(Extrapolation extrapolation);

/// True for the options whose value may be one or several tables of the user's, between commas.
[[nodiscard]] bool takes_tables(std::string_view key);

/// True for an option value that names a table of the user's rather than one of ours.
[[nodiscard]] bool is_table_path(std::string_view name);

}  // namespace osio
