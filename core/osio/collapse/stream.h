// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>
#include <osio/collapse/plan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

/// Pixels in blocks of whole rows, from a file to a consumer, a few blocks at a time.
namespace osio {

/// Some rows of some channels, planar: plane p holds rows x width samples, row after row.
struct PlanarBlock {
    int first_row = 0;
    int row_count = 0;
    std::vector<BandView> planes;
};

/// Decodes blocks for one worker. It is never shared, so it needs no lock.
class BlockReader {
  public:
    virtual ~BlockReader() = default;

    /// The block's samples; they belong to the reader and live until its next read.
    [[nodiscard]] virtual Result<PlanarBlock> read(std::size_t block) = 0;
};

/// An image that can be decoded block by block, in any order, by several readers at once.
class BlockSource {
  public:
    virtual ~BlockSource() = default;

    [[nodiscard]] virtual int width() const = 0;
    [[nodiscard]] virtual std::size_t block_count() const = 0;
    /// The block that holds a row of the data window.
    [[nodiscard]] virtual std::size_t block_of_row(int row) const = 0;
    [[nodiscard]] virtual Result<std::unique_ptr<BlockReader>> start_reader() const = 0;
};

/// Where finished rows go.
class RowSink {
  public:
    virtual ~RowSink() = default;

    /// `planes`: one pointer a channel, rows x width floats each, row after row. Calls come one at a
    /// time, in order of rows.
    [[nodiscard]] virtual Result<void> write_rows(int first_row, int row_count,
                                                  std::span<const float* const> planes) = 0;
};

/// Runs a body on several workers at once and returns when all have returned. The core makes no
/// threads: a tool gives its own, a plugin its host's.
class Runner {
  public:
    virtual ~Runner() = default;

    [[nodiscard]] virtual unsigned worker_count() const = 0;
    virtual void run(const std::function<void(unsigned worker)>& body) = 0;
};

/// Told the share of work done, 0 to 1; false cancels.
using Progress = std::function<bool(double share)>;

/// What a collapse met, for people to be told. A pixel counts once in each line that fits it.
struct CollapseCounts {
    std::uint64_t pixels = 0;
    std::uint64_t nan = 0;       ///< pixels with a NaN output
    std::uint64_t infinite = 0;  ///< pixels with an infinite output
    std::uint64_t negative = 0;  ///< pixels with a negative output

    CollapseCounts& operator+=(const CollapseCounts& other);
};

/// A range of rows of the data window, first to last, both inside.
struct RowRange {
    int first = 0;
    int last = 0;
};

/// Collapses the blocks that hold `rows` and hands them to `sink`, in order. The source's planes
/// are the plan's bands in the plan's order (null where no output needs one), then alpha where
/// `has_alpha`; the sink gets the plan's outputs, then alpha as it was. Colour stays associated
/// with alpha: a space with a curve is encoded from unassociated colour and associated again.
[[nodiscard]] Result<CollapseCounts> collapse_stream(const BlockSource& source,
                                                     const CollapsePlan& plan, bool has_alpha,
                                                     RowRange rows, RowSink& sink, Runner& runner,
                                                     const Progress& progress);

}  // namespace osio
