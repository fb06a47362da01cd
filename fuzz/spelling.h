// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/request.h>

#include <algorithm>
#include <fuzz/target.h>
#include <string>

namespace osio::fuzz {

/// A request that was read spells itself in words that read back as the same. Values that hold the
/// marks between words cannot be spelt in a query, and are only spelt.
inline void check_spelling(const CollapseRequest& request) {
    const std::string spelt = recipe_text(request);
    for (const std::string* value : {&request.illuminant, &request.observer, &request.part, &request.set,
                                     &request.white, &request.wavelengths})
        if (value->find_first_of("&=") != std::string::npos)
            return;
    CollapseRequest again;
    for (std::size_t at = 0; at < spelt.size();) {
        const std::size_t end = std::min(spelt.find('&', at), spelt.size());
        const std::size_t equals = spelt.find('=', at);
        require(equals < end);
        require(set_option(again, spelt.substr(at, equals - at), spelt.substr(equals + 1, end - equals - 1))
                    .has_value());
        at = end + 1;
    }
    require(recipe_text(again) == spelt);
}

}  // namespace osio::fuzz
