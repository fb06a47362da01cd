// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/layout/channel_layout.h>
#include <osio/layout/channel_name.h>

#include <OpenEXR/ImfHeader.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osio::image {

/// What a file says of one of its bands by other means than a channel's name.
struct BandFacts {
    double wavelength_nm = 0;  ///< 0 where it has none
    double fwhm_nm = 0;        ///< 0 where it says nothing
    bool bad = false;

    [[nodiscard]] bool usable() const { return wavelength_nm > 0 && !bad; }
};

/// A channel name a band: `T.450nm` or `S0.450nm`, distinct, for those that are usable, `band.N` and `bad.N`, counted
/// from 1, for the others.
[[nodiscard]] std::vector<std::string> channel_names(std::span<const BandFacts> bands, Family family);

/// The attribute `spectral:fwhm` of the bands that have a width; empty where none has.
[[nodiscard]] std::string fwhm_text(std::span<const BandFacts> bands);

/// Says how many bands are left out of the set, and why; `bad_by` is the key that called them bad.
void warn_of_unusable(std::span<const BandFacts> bands, std::string_view bad_by,
                      std::vector<std::string>& warnings);

/// What words such as "Radiance" or "surface reflectance" say of numbers: nothing where
/// neither or both are there.
[[nodiscard]] std::optional<Quantity> quantity_in(std::string_view words);

[[nodiscard]] constexpr Family family_of(Quantity quantity) {
    return quantity == Quantity::Radiance ? Family::S0 : Family::T;
}

/// Attributes that every part of bands has: the layout's version, units of radiance (the layout's where `units` is
/// empty), widths.
void insert_band_attributes(std::span<const BandFacts> bands, Family family, const std::string& units,
                            Imf::Header& header);

/// Completes a part whose channels have names that we made: floats, layout, metadata; `warnings` come first.
void describe_bands(const std::vector<std::string>& names, const std::vector<std::string>& warnings,
                    Part& part);

}  // namespace osio::image
