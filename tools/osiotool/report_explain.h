// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/osiotool/json_text.h>

#include <formats/image/explain.h>
#include <formats/trade/forecast.h>

#include <string>

namespace osio::tool {

/// A plan's explanation, and what carrying it out would take.
struct Explained {
    image::Explanation explanation;
    trade::CollapseForecast forecast;
    unsigned workers = 1;
};

/// Steps with their predicted seconds, then what is left out.
[[nodiscard]] std::string explain_text(const image::CollapseJob& job, const Explained& explained);
[[nodiscard]] Json explain_object(const image::CollapseJob& job, const Explained& explained);

}  // namespace osio::tool
