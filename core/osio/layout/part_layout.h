// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/layout/channel_layout.h>
#include <osio/layout/dialect.h>
#include <osio/layout/open_words.h>
#include <osio/layout/spectral_metadata.h>

#include <span>
#include <string>
#include <vector>

namespace osio {

/// What a part's names, its header and the user's words say its channels are.
struct PartLayout {
    ChannelLayout layout;
    TextAttributes attributes;          ///< what the dialect says, as attributes of the layout
    std::vector<std::string> replaced;  ///< attributes of the header that the user's words take the place of
    double scale = 1;                   ///< samples of bands times this are per nanometre
};

/// Understands a part: names of the spectral EXR layout, else the dialect of read_dialect(). Contradiction where the words do not fit it: a map that is not of its channels, a
/// quantity that its names deny.
///
/// A map of wavelengths replaces those that names or header say; root and family of a channel stay what its name
/// says. Where nothing says what bands hold, `quantity` does; without it they count as reflectance, and a warning
/// says so.
[[nodiscard]] Result<PartLayout> read_part_layout(std::span<const std::string> channel_names,
                                                  const HeaderAttributes& header, const OpenWords& words);

/// The family of bands that nothing but the user's word tells the quantity of, and the warning where there
/// is no word.
[[nodiscard]] Family assumed_family(std::optional<Quantity> quantity, std::vector<std::string>& warnings);

/// Contradiction where the user's word is not what the file says; `says` are its words.
[[nodiscard]] Result<void> check_quantity(std::optional<Quantity> word, Quantity stated,
                                          std::string_view says);

}  // namespace osio
