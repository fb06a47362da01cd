// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/stream.h>

namespace osio::trade {

/// What work tells that is `share` of a whole, from `from` on. `whole` must live as long.
[[nodiscard]] inline Progress progress_part(const Progress& whole, double from, double share) {
    if (!whole)
        return {};
    return [&whole, from, share](double done) { return whole(from + share * done); };
}

}  // namespace osio::trade
