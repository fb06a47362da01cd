// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/channel_layout.h>
#include <osio/spectra/spectrum.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace osio {

/// Names of the layout's header attributes (JCGT 10(3), 2021; exact and case-sensitive).
namespace attribute {
inline constexpr std::string_view kLayoutVersion = "spectralLayoutVersion";
inline constexpr std::string_view kEmissiveUnits = "emissiveUnits";
inline constexpr std::string_view kHandedness = "polarisationHandedness";
inline constexpr std::string_view kExposureValue = "EV";
inline constexpr std::string_view kLensTransmission = "lensTransmission";
inline constexpr std::string_view kCameraResponse = "cameraResponse";
// Ours: what a reader needs to know to make a curve of the bands.
inline constexpr std::string_view kBasis = "spectral:basis";  ///< a word of `list bases`
inline constexpr std::string_view kBinEdges =
    "spectral:binEdges";                                    ///< bands + 1 wavelengths in nm, between ';'
inline constexpr std::string_view kFwhm = "spectral:fwhm";  ///< nm: one number, or `wavelength:width;...`
inline constexpr std::string_view kReduction =
    "spectral:reduction";  ///< JSON: what these very bands were verified for, see docs/cli.md
}  // namespace attribute

/// The layout's version that is written, and the unit of emitted light in its spelling. The unit is
/// a density per nanometre although its text does not say so: every writer treats it as one.
inline constexpr std::string_view kWrittenLayoutVersion = "1.0";
inline constexpr std::string_view kWrittenEmissiveUnits = "W.m^-2.sr^-1";

/// A header's string attributes by name.
using TextAttributes = std::map<std::string, std::string, std::less<>>;

/// What a header says about its bands.
struct SpectralMetadata {
    std::optional<std::string> layout_version;
    std::optional<std::string> emissive_units;
    std::optional<std::string> handedness;
    std::optional<Spectrum> lens_transmission;
    std::optional<Spectrum> camera_response;
    std::map<std::size_t, Spectrum> sensitivities;  ///< by channel index
    std::optional<std::string> basis;
    std::vector<double> bin_edges_nm;  ///< strictly increasing, or none
    std::optional<Spectrum> fwhm;      ///< full widths at half maximum, nm, over wavelength
    std::vector<std::string> warnings;
};

/// Reads the layout's attributes. Nothing here is required of a file: what is missing or odd is a
/// warning.
[[nodiscard]] SpectralMetadata read_spectral_metadata(const ChannelLayout& layout,
                                                      const TextAttributes& attributes);

/// True for an attribute that describes bands and is meaningless once they are collapsed: the
/// layout's own names and sensitivities, which are named like a band.
[[nodiscard]] bool describes_bands(std::string_view attribute_name);

}  // namespace osio
