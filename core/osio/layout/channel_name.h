// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/spectra/wavelength.h>

#include <optional>
#include <string>
#include <string_view>

/// Channel names of the spectral EXR layout (Fichet, Pacanowski, Wilkie: An OpenEXR Layout for
/// Spectral Images, JCGT 10(3), 2021).
namespace osio {

/// What a band holds: a Stokes component of emitted light, or what a surface reflects or transmits.
enum class Family { S0, S1, S2, S3, T };

/// "S0" ... "S3", "T".
[[nodiscard]] std::string_view family_name(Family family);

/// A channel name that names a band, or a pair of bands.
struct ChannelName {
    std::string root;  ///< text before the family, without its dot; often empty
    Family family = Family::T;
    double wavelength_nm = 0;          ///< of the band; of the exciting light for a pair
    std::optional<double> emitted_nm;  ///< T.in.out only: where the light comes out again

    friend bool operator==(const ChannelName&, const ChannelName&) = default;
};

/// Reads
///
///     name     = [root "."] family "." quantity          a band
///              | [root "."] "T." quantity "." quantity   reradiation: incoming, then outgoing
///
/// with quantity as in take_wavelength_nm. `mark` is Comma for names in files, Point for our own
/// comma-free names. Anything else (`S0.R` of a renderer, `S0.550.5nm`, `T.400`) is no band name.
[[nodiscard]] std::optional<ChannelName> parse_channel_name(std::string_view name, DecimalMark mark);

/// True for a name that starts like a band, with a digit or decimal mark after the family, and that
/// parse_channel_name refuses: worth telling the user about.
[[nodiscard]] bool looks_like_a_band(std::string_view name);

/// The name in nanometres: with Comma as the layout writes it (`T.450,5nm`), with Point as hosts
/// that split at commas need it (`T.450.5nm`).
[[nodiscard]] std::string format_channel_name(const ChannelName& name, DecimalMark mark);

}  // namespace osio
