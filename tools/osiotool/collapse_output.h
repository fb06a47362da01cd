// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tools/host_module/host_module.h>
#include <tools/osiotool/commands.h>
#include <tools/osiotool/report.h>

#include <formats/exr/soundness.h>
#include <formats/image/collapse_job.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace osio::tool {

/// Where the rows of a collapse go, and what is known when they are there.
struct CollapseOutput {
    std::unique_ptr<RowSink> sink;
    std::function<Result<void>(CollapseOutcome&)> finish;
    std::string path;
};

/// "half", "float", "uint8", "uint16".
[[nodiscard]] std::string_view depth_name(host::StoredType type);

/// The depth that was asked for, else float for linear values and EXR, 8 bits for encoded ones. Usage
/// where the output or the space cannot have it.
[[nodiscard]] Result<host::StoredType> choose_depth(const CollapseOptions& options, const OutputSpace& space);

/// The depths to try where a certificate decides: those that the user left open, cheapest first.
[[nodiscard]] std::vector<host::StoredType>
depth_candidates(const CollapseOptions& options, const CollapsePlan& plan, host::StoredType chosen);

/// The same for a budget.
[[nodiscard]] StoredDepth stored_depth(host::StoredType type);

/// Opens where each job's rows go. `{illuminant}` in the output's name stands for the light's name (of a
/// table, its file name without .csv) and makes a file of each job; without it several jobs are parts
/// of one EXR, named by their lights. EXR is written by our writer, anything else by OpenImageIO's.
/// The outputs are finished in this order; the outcome's certificate goes into an EXR that has a place for it,
/// which `certified` reserves. Usage where names do not fit the lights.
[[nodiscard]] Result<std::vector<CollapseOutput>> open_outputs(const CollapseOptions& options,
                                                               const std::vector<image::CollapseJob>& jobs,
                                                               const std::vector<exr::BadRows>& missing,
                                                               host::StoredType type, bool certified);

}  // namespace osio::tool
