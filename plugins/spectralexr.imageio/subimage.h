// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <formats/image/collapse_job.h>

#include <osio/collapse/stream.h>
#include <osio/layout/presentation.h>

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>

namespace osio::plugin {

/// An image as a host sees it: a spec, and rows of interleaved pixels in the spec's native types.
class Subimage {
  public:
    Subimage(OIIO::ImageSpec spec, std::unique_ptr<BlockSource> source)
        : m_spec(std::move(spec)), m_source(std::move(source)) {}

    virtual ~Subimage() = default;

    [[nodiscard]] const OIIO::ImageSpec& spec() const { return m_spec; }

    /// The rows that are decoded together with a row; asking for less costs as much.
    [[nodiscard]] RowRange rows_around(int row) const {
        return m_source->rows_of_block(m_source->block_of_row(row));
    }

    [[nodiscard]] std::size_t row_bytes() const { return m_spec.scanline_bytes(true); }

    [[nodiscard]] std::size_t block_count() const { return m_source->block_count(); }

    /// Writes rows, both ends inside, one after another to `out`: row_bytes() each.
    [[nodiscard]] virtual Result<void> read_rows(RowRange rows, std::byte* out, Runner& runner) = 0;

  protected:
    [[nodiscard]] const BlockSource& source() const { return *m_source; }

  private:
    OIIO::ImageSpec m_spec;
    std::unique_ptr<BlockSource> m_source;
};

/// A part with all its channels, as they are stored; one of `subimage_count` that the host sees.
[[nodiscard]] Result<std::unique_ptr<Subimage>>
make_raw_subimage(std::shared_ptr<const image::SpectralImage> file, std::size_t part, BandNames names,
                  int subimage_count);

/// A part's bands as channels of a space, and alpha; one of `subimage_count`, one a light, that the host
/// sees, and then named by its light. With a certificate as an attribute where that is not empty.
[[nodiscard]] Result<std::unique_ptr<Subimage>>
make_collapsed_subimage(image::CollapseJob job, int subimage_count, const std::string& certificate);

}  // namespace osio::plugin
