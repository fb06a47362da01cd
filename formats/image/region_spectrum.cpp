// SPDX-License-Identifier: Apache-2.0
#include <formats/image/region_spectrum.h>

#include <osio/collapse/kernel.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace osio::image {

namespace {

std::string corners(const Window& window) {
    return std::to_string(window.min_x) + "," + std::to_string(window.min_y) + " to " +
           std::to_string(window.max_x) + "," + std::to_string(window.max_y);
}

bool holds(const Window& outer, const Window& inner) {
    return inner.min_x >= outer.min_x && inner.max_x <= outer.max_x && inner.min_y >= outer.min_y &&
           inner.max_y <= outer.max_y && inner.min_x <= inner.max_x && inner.min_y <= inner.max_y;
}

/// Adds a band's samples, `count` from `first` on.
void add(const BandView& band, std::size_t first, std::size_t count, std::uint64_t& defined,
         BandSpread& out) {
    for (std::size_t pixel = first; pixel < first + count; ++pixel) {
        const double value = sample_at(band, pixel);
        if (!std::isfinite(value)) {
            ++out.undefined;
            continue;
        }
        out.minimum = defined == 0 ? value : std::min(out.minimum, value);
        out.maximum = defined == 0 ? value : std::max(out.maximum, value);
        out.mean += value;  // the sum, until all are in
        ++defined;
    }
}

}  // namespace

Result<std::vector<BandSpread>> region_spectrum(const SpectralImage& image, const Selection& selection,
                                                const Window& region) {
    const Part& part = image.parts()[selection.part];
    if (!holds(part.data_window, region))
        return fail(ErrorCode::Usage,
                    "the pixels " + corners(region) + " are not all inside the data window, " +
                        corners(part.data_window),
                    image.path());
    const SpectralSet& set = part.layout.sets[selection.set];
    PlaneChannels planes;
    std::vector<BandSpread> out;
    for (const Band& band : set.bands) {
        planes.emplace_back(band.channel);
        out.push_back({band.wavelength_nm, 0, 0, 0, 0});
    }
    OSIO_TRY(const auto source, image.make_block_source(selection.part, std::move(planes), Grain::Block));
    OSIO_TRY(const auto reader, source->start_reader());
    std::vector<std::uint64_t> defined(out.size());
    const auto first = static_cast<std::size_t>(region.min_x - part.data_window.min_x);
    const auto count = static_cast<std::size_t>(region.width());
    const std::size_t last_block = source->block_of_row(region.max_y);
    for (std::size_t index = source->block_of_row(region.min_y); index <= last_block; ++index) {
        OSIO_TRY(const PlanarBlock block, reader->read(index));
        const PlanarBlock wanted = block.among({region.min_y, region.max_y});
        for (int row = wanted.first_row; row < wanted.first_row + wanted.row_count; ++row) {
            const PlanarBlock line = wanted.among({row, row});
            for (std::size_t band = 0; band < out.size(); ++band)
                add(line.planes[band], first, count, defined[band], out[band]);
        }
    }
    for (std::size_t band = 0; band < out.size(); ++band)
        if (defined[band] != 0)
            out[band].mean /= static_cast<double>(defined[band]);
    return out;
}

}  // namespace osio::image
