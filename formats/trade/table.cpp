// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/progress_part.h>
#include <formats/trade/table.h>

#include <algorithm>

namespace osio::trade {

namespace {

/// The share of the work that looking at every pixel takes, about; the rest is shared by the runs.
constexpr double kWorthShare = 0.2;

/// A choice that another makes pointless: nearer, or as near, and not slower; and better in one of both.
bool beats(const Offer& a, const Offer& b) {
    const double near_a = a.worth.delta_e_max, near_b = b.worth.delta_e_max;
    const bool same_time = a.cost.all.same_as(b.cost.all);
    const bool faster = !same_time && a.cost.all.median < b.cost.all.median;
    return near_a <= near_b && (faster || (same_time && near_a < near_b));
}

}  // namespace

void sort_and_mark(std::vector<Offer>& offers) {
    std::stable_sort(offers.begin(), offers.end(),
                     [](const Offer& a, const Offer& b) { return a.cost.all.median < b.cost.all.median; });
    for (Offer& offer : offers)
        offer.on_front = std::none_of(offers.begin(), offers.end(),
                                      [&offer](const Offer& other) { return beats(other, offer); });
}

Result<Table> make_table(const image::CollapseJob& job, const AllChoices& all, int runs, MemoryMeter meter,
                         const TextLoader& load_text, Runner& runner, const Progress& progress) {
    Table out;
    out.white_luminance = all.white.y;
    out.white_reason = all.white.reason;
    out.recipe = recipe_text(job.plan.request);
    out.workers = runner.worker_count();
    out.runs = runs;
    OSIO_TRY(const std::vector<Worth> worths,
             worth_of(job, all.choices, runner, progress_part(progress, 0, kWorthShare)));
    OSIO_TRY(const auto bench, Workbench::create(job, all.choices, std::move(meter)));
    const std::vector<Choice>& list = bench->choices().list;
    const double each = (1 - kWorthShare) / static_cast<double>(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        const double from = kWorthShare + each * static_cast<double>(i);
        OSIO_TRY(const Cost cost,
                 bench->measure(i, runs, load_text, runner, progress_part(progress, from, 0)));
        out.offers.push_back({list[i].name, list[i].meaning, list[i].bands, cost, worths[i], false});
    }
    sort_and_mark(out.offers);
    return out;
}

}  // namespace osio::trade
