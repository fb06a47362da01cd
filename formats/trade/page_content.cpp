// SPDX-License-Identifier: Apache-2.0
#include <formats/files/png_output.h>
#include <formats/files/zlib_stream.h>
#include <formats/image/grid_spectra.h>
#include <formats/trade/number_codes.h>
#include <formats/trade/page_content.h>
#include <formats/trade/pictures.h>
#include <formats/trade/progress_part.h>

#include <algorithm>

namespace osio::trade {

namespace {

/// Spectra take no more room than this, however much there is, packed and as codes: they are looked at one by one.
constexpr std::size_t kMostPackedSpectra = 4'000'000, kMostSpectraCodes = 16'000'000;

/// The share of the work that comparing every pixel is, about.
constexpr double kViewsShare = 0.8;

image::BlockGrid picture_grid(const image::Window& window) {
    const int longest = std::max(window.width(), window.height());
    return {window, (longest + kMostPicturePixels - 1) / kMostPicturePixels};
}

/// How many bytes the pictures and maps of `out` take, which become those of its grid.
Result<std::size_t> add_views(const image::CollapseJob& job, const Choices& choices, Runner& runner,
                              const Progress& progress, PageContent& out) {
    OSIO_TRY(const std::vector<Picture> pictures, pictures_of(job, choices, out.grid, runner, progress));
    out.pictures.clear();
    out.choices.clear();
    std::size_t bytes = 0;
    for (std::size_t choice = 0; choice < pictures.size(); ++choice) {
        const Picture& picture = pictures[choice];
        OSIO_TRY(std::string png,
                 files::png_of_srgb(picture.srgb, static_cast<std::size_t>(out.grid.columns())));
        const auto same = std::find(out.pictures.begin(), out.pictures.end(), png);
        const auto at = static_cast<std::size_t>(same - out.pictures.begin());
        if (same == out.pictures.end()) {
            bytes += png.size();
            out.pictures.push_back(std::move(png));
        }
        const NumberCodes codes = codes_of_differences(picture.delta_e);
        out.choices.push_back(
            {choices.list[choice].name, at, picture.clipped, files::zlib_stream_of(codes.bytes), codes.unit});
        bytes += out.choices.back().delta_e.size();
    }
    return bytes;
}

/// Spectra of squares that are as small as `room` bytes allow, whole ones of the pictures' in each.
Result<void> add_spectra(const image::CollapseJob& job, std::size_t room, Runner& runner,
                         const Progress& progress, PageContent& out) {
    const std::vector<SpectralSet>& sets = job.part().layout.sets;
    const Selection selection{job.part_index, static_cast<std::size_t>(&job.set() - sets.data())};
    image::BlockGrid& grid = out.spectra_grid;
    grid = out.grid;
    const auto coarsen_until = [&](std::size_t most_codes) {
        while (2 * job.set().bands.size() * grid.squares() > most_codes && grid.squares() > 1)
            grid.side += out.grid.side;
    };
    coarsen_until(kMostSpectraCodes);
    for (;;) {
        OSIO_TRY(const std::vector<float> samples,
                 image::grid_spectra(*job.file, selection, grid, runner, progress));
        const NumberCodes codes = codes_of_samples(samples);
        out.spectra = files::zlib_stream_of(codes.bytes);
        out.spectra_unit = codes.unit;
        if (out.spectra.size() <= room || grid.squares() == 1)
            return {};
        // Fewer spectra pack as well as these, about; each time at least one square in eight goes.
        coarsen_until(codes.bytes.size() * std::min(room, out.spectra.size() / 8 * 7) / out.spectra.size());
    }
}

}  // namespace

Result<PageContent> make_page_content(const image::CollapseJob& job, const Choices& choices,
                                      std::size_t most_bytes, Runner& runner, const Progress& progress) {
    PageContent out;
    out.grid = picture_grid(job.part().data_window);
    const Progress of_views = progress_part(progress, 0, kViewsShare);
    OSIO_TRY(std::size_t used, add_views(job, choices, runner, of_views, out));
    while (used > most_bytes / 3 * 2) {
        out.grid.side *= 2;
        OSIO_TRY(used, add_views(job, choices, runner, of_views, out));
    }
    const std::size_t room = std::min(most_bytes - used, kMostPackedSpectra);
    const Progress of_spectra = progress_part(progress, kViewsShare, 1 - kViewsShare);
    OSIO_CHECK_OK(add_spectra(job, room, runner, of_spectra, out));
    return out;
}

}  // namespace osio::trade
