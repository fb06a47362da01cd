// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/dialect.h>

#include <optional>
#include <span>
#include <string>

namespace osio {

/// Renderers whose bands are bins by their names. Nothing where fewer than two channels fit.
///
/// Mitsuba 0.4 to 0.6: `[layer.]395.00-405.00nm`, half-open bins, radiance. The wavelength is the bin's middle. Where
/// every layer's bins follow each other to 0.011 nm, which is their rounding, and the layers have the same, their edges
/// are spectral:binEdges; else spectral:basis is bins, whose edges lie midway between the middles, with a warning.
[[nodiscard]] std::optional<DialectReading> read_mitsuba_bins(std::span<const std::string> channel_names);

/// Indigo: `[spectral.]wavelength430_25`, lower edges of equal buckets, radiance per metre of wavelength, of which
/// 1e-9 is per nanometre. The last bucket is as wide as the mean of the others where they are equal to 0.02 nm, else as
/// the one before it, with a warning.
[[nodiscard]] std::optional<DialectReading> read_indigo_buckets(std::span<const std::string> channel_names);

}  // namespace osio
