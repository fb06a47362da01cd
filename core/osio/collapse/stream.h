// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osio/base/result.h>
#include <osio/collapse/band_view.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Pixels in blocks of whole rows, from a file to a consumer, a few blocks at a time.
namespace osio {

/// A range of rows of the data window, first to last, both inside.
struct RowRange {
    int first = 0;
    int last = 0;
};

/// Some rows of some channels, planar: plane p holds row_count x width samples.
struct PlanarBlock {
    int first_row = 0;
    int row_count = 0;
    int width = 0;
    std::vector<BandView> planes;  ///< from the first row's first sample on
    /// Bytes from a row to the next in every plane; 0 where each plane's rows follow each other.
    std::ptrdiff_t row_pitch_bytes = 0;

    /// Pixels that follow each other in every plane: how many there are from `first_pixel` of the block
    /// on, and their samples.
    using Run =
        std::function<void(std::size_t first_pixel, std::size_t count, std::span<const BandView> planes)>;

    /// Runs that make up the block, from its top.
    void for_each_run(const Run& run) const;

    /// The rows of the block among `rows`, which has some of them.
    [[nodiscard]] PlanarBlock among(RowRange rows) const;
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
    [[nodiscard]] virtual RowRange rows_of_block(std::size_t block) const = 0;
    [[nodiscard]] virtual Result<std::unique_ptr<BlockReader>> start_reader() const = 0;
};

/// Another source's blocks, which start_reader() of the derived class makes something of.
class WrappedSource : public BlockSource {
  public:
    [[nodiscard]] int width() const final { return m_inner->width(); }

    [[nodiscard]] std::size_t block_count() const final { return m_inner->block_count(); }

    [[nodiscard]] std::size_t block_of_row(int row) const final { return m_inner->block_of_row(row); }

    [[nodiscard]] RowRange rows_of_block(std::size_t block) const final {
        return m_inner->rows_of_block(block);
    }

  protected:
    explicit WrappedSource(std::unique_ptr<BlockSource> inner) : m_inner(std::move(inner)) {}

    [[nodiscard]] const BlockSource& inner() const { return *m_inner; }

  private:
    std::unique_ptr<BlockSource> m_inner;
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

/// What one worker does with blocks. Each worker has its own visitor; only deliver() is serialised.
class BlockVisitor {
  public:
    virtual ~BlockVisitor() = default;

    /// Works on a block, while other workers work on theirs.
    virtual void process(const PlanarBlock& block) = 0;

    /// Hands on what process() made of the same block. One call at a time, blocks in order.
    [[nodiscard]] virtual Result<void> deliver(const PlanarBlock& block) = 0;
};

/// Makes a worker's visitor.
using StartVisitor = std::function<std::unique_ptr<BlockVisitor>()>;

/// Reads the blocks that hold `rows` on the runner's workers, each block once. Memory is one block a
/// worker, whatever the image. A failure stops the work; that of the first bad block is returned,
/// whichever was met first.
[[nodiscard]] Result<void> visit_blocks(const BlockSource& source, RowRange rows, Runner& runner,
                                        const StartVisitor& start, const Progress& progress);

}  // namespace osio
