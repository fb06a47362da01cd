// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <string>

namespace osio::image {

/// Y of what counts as white, in the units of a job's Y, and why.
struct WhiteLuminance {
    double y = 1;
    std::string reason;
};

/// The request's `white-luminance`; else 1, the perfect diffuser, for a reflectance; else the 99th percentile of Y,
/// for which the image is read. 1 where that is not above 0.
[[nodiscard]] Result<WhiteLuminance> white_luminance_of(const CollapseJob& job, const TextLoader& load_text,
                                                        Runner& runner, const Progress& progress);

}  // namespace osio::image
