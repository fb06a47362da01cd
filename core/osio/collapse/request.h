// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/colour/adaptation.h>
#include <osio/colour/rgb_space.h>
#include <osio/spectra/basis.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace osio {

/// How output channels are called.
enum class OutputNames {
    Default,  ///< R, G, B of a collapse; comma-free band names otherwise
    Rgb,      ///< R, G, B
    Xyz,      ///< X, Y, Z; only where the values are tristimulus values
    Layout,   ///< bands by the file's own names; only without a collapse
};

/// Every choice of a collapse, defaulted in one place. The same words serve the command line, file
/// queries, recipe files and host hints.
struct CollapseRequest {
    std::optional<OutputSpace> to;  ///< nothing: the bands themselves
    std::string illuminant;         ///< a name or the path of a .csv; empty: none
    std::string observer = "cie1931";
    std::string part;  ///< index or name; empty: the only one with bands
    std::string set;   ///< "T", "S0", "left.T"; empty: the only one
    Basis basis = Basis::Linear;
    Extrapolation extrapolation = Extrapolation::Hold;
    std::string white;  ///< an illuminant's name, a .csv or "x,y"; empty: see docs
    Adaptation adaptation = Adaptation::Bradford;
    double exposure_stops = 0;
    OutputNames names = OutputNames::Default;
};

/// One option: `key` is the word, `value` what it takes, `help` a line for people.
struct RequestOption {
    std::string_view key;
    std::string_view value;
    std::string_view help;
};

/// Every option, in the order in which a recipe spells them.
[[nodiscard]] std::span<const RequestOption> request_options();

/// Sets one option from its text. Usage or UnknownName says what was found and expected.
[[nodiscard]] Result<void> set_option(CollapseRequest& request, std::string_view key, std::string_view value);

/// The request as `key=value&...`: every choice that matters to the result, defaults included, in a
/// fixed order. Reading it back gives the same request.
[[nodiscard]] std::string recipe_text(const CollapseRequest& request);

/// "linear"; "hold", "zero".
[[nodiscard]] std::string_view basis_name(Basis basis);
[[nodiscard]] std::string_view extrapolation_name(Extrapolation extrapolation);

/// True for an option value that names a table of the user's rather than one of ours.
[[nodiscard]] bool is_table_path(std::string_view name);

}  // namespace osio
