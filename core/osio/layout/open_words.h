// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/layout/band_map.h>
#include <osio/layout/channel_layout.h>

#include <optional>

namespace osio {

/// What a user says of a file that the file itself does not say. Readers need it when they open.
struct OpenWords {
    std::optional<BandMap> wavelengths;
    std::optional<Quantity> quantity;
};

}  // namespace osio
