// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>
#include <formats/reduce/reduction.h>

#include <osio/reduce/demand.h>

#include <memory>
#include <string>
#include <vector>

namespace osio::reduce {

/// An image and what is demanded of its reduction.
struct Subject {
    std::vector<image::CollapseJob> jobs;  ///< one a demand, to X, Y, Z
    std::vector<Demand> demands;
    WeightMatrix weights;  ///< of all demands, 3 rows each, by the original's columns
    double white_luminance = 1;
    std::string white_reason;
    std::vector<CollapsePlan> beside;  ///< of other demands, whose columns are read too

    [[nodiscard]] const image::CollapseJob& job() const { return jobs.front(); }

    [[nodiscard]] std::size_t columns() const { return weights.bands(); }

    /// Columns that some demand needs.
    [[nodiscard]] std::size_t weighed() const {
        std::size_t out = 0;
        for (std::size_t column = 0; column < columns(); ++column)
            out += weights.needs(column);
        return out;
    }

    void add(image::CollapseJob job, double white_luminance);

    /// The columns that any demand needs, or a plan beside them, then alpha.
    [[nodiscard]] Result<std::unique_ptr<BlockSource>> open_source(image::Grain grain) const {
        return image::open_source(jobs, beside, grain);
    }
};

/// Opens the image and makes a job of each light and observer; the refusals of reduce() that need no pixel.
[[nodiscard]] Result<Subject> open_subject(const Request& request, const TextLoader& load_text,
                                           Runner& runner, const Progress& progress);

/// The same image under every light of ours that was not asked for, by the first observer; of radiance for every
/// colorimetric observer that was not.
[[nodiscard]] Subject other_demands(const Subject& subject, const TextLoader& load_text);

}  // namespace osio::reduce
