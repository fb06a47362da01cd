// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/spectral_image.h>

#include <osio/collapse/plan.h>
#include <osio/collapse/stream.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace osio::image {

struct CollapseJob;

/// The columns that any of some jobs for the same set needs, or of further plans for the same bands, then alpha.
[[nodiscard]] Result<std::unique_ptr<BlockSource>> open_source(std::span<const CollapseJob> jobs,
                                                               std::span<const CollapsePlan> beside = {},
                                                               Grain grain = Grain::Block);

/// A file, the part of it that a request means, and the plan for its bands: everything that is
/// decided before a pixel is read.
struct CollapseJob {
    std::shared_ptr<const SpectralImage> file;
    std::size_t part_index = 0;
    CollapsePlan plan;
    std::optional<std::size_t> alpha;   ///< channel that passes through
    std::vector<std::string> warnings;  ///< of the layout and of the plan

    [[nodiscard]] const Part& part() const { return file->parts()[part_index]; }

    /// The bands that the plan is for.
    [[nodiscard]] const SpectralSet& set() const { return *part().layout.find_set(plan.request.set); }

    /// Names of the result's channels, alpha last.
    [[nodiscard]] std::vector<std::string> channel_names() const;

    /// The columns that the plan needs, then alpha.
    [[nodiscard]] Result<std::unique_ptr<BlockSource>> open_source(Grain grain = Grain::Block) const {
        return image::open_source({this, 1}, {}, grain);
    }

    /// How the samples of the plan's columns are stored.
    [[nodiscard]] std::vector<SampleType> column_types() const;

    /// How the samples of the source's planes are stored.
    [[nodiscard]] std::vector<SampleType> plane_types() const;
};

/// Opens the file, chooses the set and makes the plan under one light at most; every refusal comes from
/// here.
[[nodiscard]] Result<CollapseJob> open_collapse(const std::string& path, const CollapseRequest& request,
                                                const TextLoader& load_text);

/// The jobs of a request for several lights, or the one of any other: same file, part and set. Usage where
/// two lights are the same.
[[nodiscard]] Result<std::vector<CollapseJob>>
open_collapses(const std::string& path, const CollapseRequest& request, const TextLoader& load_text);

/// The same for a file that is open already.
[[nodiscard]] Result<std::vector<CollapseJob>>
prepare_collapses(const std::shared_ptr<const SpectralImage>& file, const CollapseRequest& request,
                  const TextLoader& load_text);

/// One job for a file that is open already.
[[nodiscard]] Result<CollapseJob> prepare_collapse(std::shared_ptr<const SpectralImage> file,
                                                   const CollapseRequest& request,
                                                   const TextLoader& load_text);

}  // namespace osio::image
