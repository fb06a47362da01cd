// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/channel_name.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace osio {

/// What a sample is, and with it whether a light has still to be applied.
enum class Quantity {
    Reflectance,  ///< reflected or transmitted share: needs an illuminant
    Radiance,     ///< emitted or reflected light: must not get one
};

/// "reflectance", "radiance".
[[nodiscard]] std::string_view quantity_name(Quantity quantity);

/// T is reflectance, the Stokes components are radiance.
[[nodiscard]] Quantity quantity_of(Family family);

/// A band and the channel that holds it, as an index into ChannelLayout::channel_names.
struct Band {
    double wavelength_nm = 0;
    std::size_t channel = 0;
};

/// A fluorescent pair: light at excited_nm that leaves at emitted_nm. Its sample is an element of the
/// Donaldson matrix: see reradiation_weights.
struct Reradiation {
    double excited_nm = 0;
    double emitted_nm = 0;
    std::size_t channel = 0;
};

/// The bands of one root and family: one spectral image.
struct SpectralSet {
    std::string root;
    Family family = Family::T;
    std::vector<Band> bands;               ///< by wavelength; equal wavelengths in channel order
    std::vector<Reradiation> reradiation;  ///< by excited_nm, then emitted_nm, then channel

    /// "T", "S0", "left.T": what `--set` takes.
    [[nodiscard]] std::string name() const;
    [[nodiscard]] Quantity quantity() const;
    [[nodiscard]] std::vector<double> wavelengths_nm() const;
};

/// Whose way of naming bands a part follows, and what told it.
struct Dialect {
    std::string name;                     ///< "spectral EXR layout", "Mitsuba 0.x bins", ...; empty: none
    std::string evidence;                 ///< in words; empty without a name
    std::vector<std::string> attributes;  ///< of the header, that say what a band is and no more
};

/// True for an attribute of the header that says what a band is, and nothing once bands have other names.
[[nodiscard]] bool names_a_band(const Dialect& dialect, std::string_view attribute_name);

/// The sentence about a dialect that was recognised and holds no wavelengths, with what to do.
[[nodiscard]] std::string without_wavelengths(const Dialect& dialect);

/// The name of the layout that this project writes.
inline constexpr std::string_view kLayoutDialect = "spectral EXR layout";

/// What the channels of one part are.
struct ChannelLayout {
    std::vector<std::string> channel_names;  ///< the file's own
    Dialect dialect;
    std::vector<SpectralSet> sets;      ///< by root, then S0, S1, S2, S3, T
    std::vector<std::size_t> others;    ///< channels that are no bands, in ascending order
    std::vector<std::string> warnings;  ///< sentences for people

    /// Index of the channel with exactly that name.
    [[nodiscard]] std::optional<std::size_t> find_channel(std::string_view name) const;

    /// The set of that name; null where there is none.
    [[nodiscard]] const SpectralSet* find_set(std::string_view name) const;

    /// The alpha that goes with a set: `ROOT.A`, else `A`.
    [[nodiscard]] std::optional<std::size_t> alpha_of(const SpectralSet& set) const;
};

/// Sorts channels into sets: what each channel is, nothing for one that is no band. Every channel appears
/// exactly once, in a set or in `others`. Duplicate wavelengths and pairs, and
/// reradiation that does not make waves longer, are reported as warnings.
[[nodiscard]] ChannelLayout make_channel_layout(std::span<const std::string> channel_names,
                                                std::span<const std::optional<ChannelName>> meanings);

/// The layout of names of the spectral EXR layout. Names that miss its grammar by little are one more warning.
[[nodiscard]] ChannelLayout parse_channel_layout(std::span<const std::string> channel_names,
                                                 DecimalMark mark);

}  // namespace osio
