// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/request.h>
#include <osio/layout/channel_layout.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace osio {

/// What choosing needs to know of one part of a file.
struct PartSummary {
    std::string name;  ///< empty in most single-part files
    const ChannelLayout* layout = nullptr;
    bool deep = false;             ///< several samples a pixel
    std::vector<bool> subsampled;  ///< by channel: fewer samples than pixels
};

/// One set of bands in one part.
struct Selection {
    std::size_t part = 0;
    std::size_t set = 0;
};

/// The part of that name, else of that index. NoSuchPart lists the parts.
[[nodiscard]] Result<std::size_t> select_part(std::span<const PartSummary> parts, const std::string& part);

/// The set that a request means: `part` and `set` where they are given, otherwise the only set of
/// the file (S1, S2 and S3 stand back where there is S0 or T; polarimetric spaces take the only root with
/// Stokes components). Refuses what is not there or fits
/// several, listing what the file has; a file without bands (NotSpectral, with the dialect's name
/// where it is known); deep parts and sub-sampled bands.
[[nodiscard]] Result<Selection> select_set(std::span<const PartSummary> parts,
                                           const CollapseRequest& request);

}  // namespace osio
