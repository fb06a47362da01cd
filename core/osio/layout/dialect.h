// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/channel_layout.h>
#include <osio/layout/spectral_metadata.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

/// How programs beside those of the spectral EXR layout name bands (docs/formats.md, "Dialects").
namespace osio {

/// A header's attributes, as far as dialects use them.
struct HeaderAttributes {
    TextAttributes texts;
    TextAttributes numbers;  ///< floats and doubles, as their shortest decimals
};

/// What one dialect makes of a part.
struct DialectReading {
    Dialect dialect;
    /// By channel; the family is T where the quantity is unknown. No band at all where a program was
    /// recognised that states no wavelengths.
    std::vector<std::optional<ChannelName>> bands;
    std::optional<Quantity> quantity;  ///< what the dialect says; nothing: unknown
    TextAttributes attributes;         ///< what it says beside, as attributes of the layout
    double scale = 1;                  ///< samples times this are per nanometre
    std::vector<std::string> warnings;
};

/// The first of these that fits two or more channels: Ocean's `.wavelength` attributes, Mitsuba 0.x bins, Indigo
/// buckets, ISET3D bands, GDAL bands, Mitsuba 3 films, OpenCV's numbers, and names that each hold one wavelength
/// with its unit. For parts without names of the spectral EXR layout.
[[nodiscard]] std::optional<DialectReading> read_dialect(std::span<const std::string> channel_names,
                                                         const HeaderAttributes& header);

}  // namespace osio
