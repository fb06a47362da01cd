// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/trade/all_choices.h>
#include <formats/trade/cost.h>
#include <formats/trade/worth.h>

#include <string>
#include <vector>

namespace osio::trade {

/// A choice with what it costs and what it is worth.
struct Offer {
    std::string name;
    std::string meaning;
    std::size_t bands = 0;
    Cost cost;
    Worth worth;
    bool on_front = false;  ///< no other is both surely faster and nearer, or as near
};

/// The exchange rate of one image.
struct Table {
    std::vector<Offer> offers;  ///< cheapest first
    std::string recipe;         ///< of the exact collapse
    double white_luminance = 1;
    std::string white_reason;
    unsigned workers = 1;
    int runs = 1;
};

/// Sorts by the median of seconds and marks the Pareto front of seconds and largest CIEDE2000. A difference of seconds
/// that noise hides (Seconds::same_as) counts as none.
void sort_and_mark(std::vector<Offer>& offers);

/// Measures every choice of the job's image. The refusals of reading.
[[nodiscard]] Result<Table> make_table(const image::CollapseJob& job, const AllChoices& all, int runs,
                                       MemoryMeter meter, const TextLoader& load_text, Runner& runner,
                                       const Progress& progress);

}  // namespace osio::trade
