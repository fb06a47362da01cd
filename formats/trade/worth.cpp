// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/compare.h>
#include <formats/trade/worth.h>

#include <osio/base/value_statistics.h>

#include <algorithm>

namespace osio::trade {

Result<std::vector<Worth>> worth_of(const image::CollapseJob& job, const Choices& choices, Runner& runner,
                                    const Progress& progress) {
    std::vector<Worth> worths(choices.list.size());
    std::vector<ValueStatistics> deltas(worths.size());
    const auto add = [&](const ComparedRows& rows) {
        for (const float delta : rows.delta_e)
            deltas[rows.choice].add(static_cast<double>(delta));
        double& largest = worths[rows.choice].largest_xyz;
        largest = std::max(largest, rows.largest_xyz);
    };
    OSIO_CHECK_OK(compare(job, choices, runner, progress, add));
    for (std::size_t choice = 0; choice < worths.size(); ++choice) {
        Worth& worth = worths[choice];
        const ValueStatistics& delta = deltas[choice];
        worth.delta_e_mean = delta.mean();
        worth.delta_e_95 = delta.percentile(95);
        worth.delta_e_99_9 = delta.percentile(99.9);
        worth.delta_e_max = delta.maximum();
        worth.undefined_pixels = delta.undefined_count();
    }
    return worths;
}

}  // namespace osio::trade
