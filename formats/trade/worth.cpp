// SPDX-License-Identifier: Apache-2.0
#include <formats/trade/compare.h>
#include <formats/trade/worth.h>

#include <algorithm>

namespace osio::trade {

Result<std::vector<Worth>> worth_of(const image::CollapseJob& job, const Choices& choices, Runner& runner,
                                    const Progress& progress) {
    std::vector<Worth> worths(choices.list.size());
    const auto add = [&worths](const ComparedRows& rows) {
        Worth& worth = worths[rows.choice];
        for (const float delta : rows.delta_e)
            worth.delta_e.add(static_cast<double>(delta));
        worth.largest_xyz = std::max(worth.largest_xyz, rows.largest_xyz);
    };
    OSIO_CHECK_OK(compare(job, choices, runner, progress, add));
    return worths;
}

}  // namespace osio::trade
