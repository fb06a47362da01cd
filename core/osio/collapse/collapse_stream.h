// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/collapse/plan.h>
#include <osio/collapse/polarisation_stage.h>
#include <osio/collapse/stream.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace osio {

/// A worker's way to a sink.
class RowWorker {
  public:
    virtual ~RowWorker() = default;

    /// Finished rows, before their turn and beside other workers; the planes live until deliver().
    [[nodiscard]] virtual Result<void> prepare(int first_row, int row_count,
                                               std::span<const float* const> planes) = 0;

    /// Hands on what was prepared: one call at a time, in order of rows.
    [[nodiscard]] virtual Result<void> deliver() = 0;
};

/// Where finished rows go.
class RowSink {
  public:
    virtual ~RowSink() = default;

    /// `planes`: one pointer a channel, rows x width floats each, row after row. Calls come one at a
    /// time, in order of rows.
    [[nodiscard]] virtual Result<void> write_rows(int first_row, int row_count,
                                                  std::span<const float* const> planes) = 0;

    /// For sinks that have work which needs no order, such as compression. By default all is done by
    /// write_rows().
    [[nodiscard]] virtual std::unique_ptr<RowWorker> start_worker();
};

/// What a collapse met, for people to be told. A pixel counts once in each line that fits it.
struct CollapseCounts {
    std::uint64_t pixels = 0;
    std::uint64_t nan = 0;       ///< pixels with a NaN output
    std::uint64_t infinite = 0;  ///< pixels with an infinite output
    std::uint64_t negative = 0;  ///< pixels with a negative output, where that is outside what is real
    PolarisationCounts polarisation{};

    CollapseCounts& operator+=(const CollapseCounts& other);
};

/// A worker's eyes of a witness.
class WitnessWorker {
  public:
    virtual ~WitnessWorker() = default;

    /// Some pixels: the plan's bands as they were read, and the sums that were made of them, before any
    /// curve.
    virtual void look(std::span<const BandView> bands, std::size_t count,
                      std::span<const float* const> sums) = 0;

    /// Hands on what was seen since the last call: one call at a time.
    virtual void deliver() = 0;
};

/// Looks on while a plan is carried out. It sees whole blocks: of a part of the rows, more than those.
class CollapseWitness {
  public:
    virtual ~CollapseWitness() = default;

    [[nodiscard]] virtual std::unique_ptr<WitnessWorker> start_worker() = 0;
};

/// A plan, where its rows go, and who looks on.
struct CollapseTarget {
    const CollapsePlan& plan;
    RowSink& sink;
    CollapseWitness* witness = nullptr;
};

/// Collapses the blocks that hold `rows` and hands the rows to the sinks. The source's planes are the
/// plans' columns in the plans' order (null where no output of any needs one), then alpha where
/// `has_alpha`; each sink gets its plan's outputs, then alpha as it was. Colour stays associated with
/// alpha: a space with a curve is encoded from unassociated colour and associated again.
///
/// All plans must be for the same columns, as those of one request under several lights are: each block
/// is decoded and gone over once for all of them. Counts come in the order of the targets.
[[nodiscard]] Result<std::vector<CollapseCounts>> collapse_stream(const BlockSource& source,
                                                                  std::span<const CollapseTarget> targets,
                                                                  bool has_alpha, RowRange rows,
                                                                  Runner& runner, const Progress& progress);

/// The same for one plan.
[[nodiscard]] Result<CollapseCounts> collapse_stream(const BlockSource& source, const CollapsePlan& plan,
                                                     bool has_alpha, RowRange rows, RowSink& sink,
                                                     Runner& runner, const Progress& progress);

}  // namespace osio
