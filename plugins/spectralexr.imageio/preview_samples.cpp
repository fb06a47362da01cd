// SPDX-License-Identifier: Apache-2.0
#include <plugins/spectralexr.imageio/preview_samples.h>

#include <formats/exr/exr_file.h>

#include <osio/collapse/kernel.h>
#include <osio/collapse/plan.h>

#include <algorithm>
#include <cmath>

namespace osio::plugin {

namespace {

/// Enough to see an edit of a thousandth of a picture.
constexpr std::size_t kMostSamples = std::size_t{1} << 18;
constexpr std::size_t kMostBlocks = 16;

/// XYZ of the bands: under D65 for reflectances, whose previews are made under some daylight.
Result<CollapsePlan> xyz_plan(const SpectralSet& set) {
    CollapseRequest request;
    OSIO_CHECK_OK(set_option(request, "to", "xyz"));
    if (set.quantity() == Quantity::Reflectance)
        request.illuminant = "D65";
    return make_plan(set, request, [](std::string_view path) -> Result<std::string> {
        return fail(ErrorCode::Io, "no file is read here", std::string(path));
    });
}

}  // namespace

std::optional<PreviewChannels> PreviewChannels::find(const ChannelLayout& layout) {
    const auto r = layout.find_channel("R"), g = layout.find_channel("G"), b = layout.find_channel("B");
    if (!r || !g || !b)
        return std::nullopt;
    for (const SpectralSet& set : layout.sets)
        if (set.root.empty() && !set.bands.empty() && (set.family == Family::S0 || set.family == Family::T))
            return PreviewChannels{set, {*r, *g, *b}};
    return std::nullopt;
}

std::vector<PreviewSample> preview_samples(const PreviewChannels& channels, const PlanarBlock& block) {
    const auto plan = xyz_plan(channels.set);
    if (!plan)
        return {};  // bands that no observer sees have no picture
    const auto width = static_cast<std::size_t>(block.width);
    const double pixels = static_cast<double>(width) * static_cast<double>(block.row_count);
    const auto step = static_cast<std::size_t>(
        std::ceil(std::sqrt(std::max(1.0, pixels / static_cast<double>(kMostSamples)))));
    std::vector<PreviewSample> out;
    std::vector<BandView> at(plan->columns.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(block.row_count); y += step) {
        const int row = block.first_row + static_cast<int>(y);
        const std::vector<BandView> planes = block.among({row, row}).planes;
        for (std::size_t x = 0; x < width; x += step) {
            std::array<float, 3> xyz{};
            const std::array<float*, 3> to{&xyz[0], &xyz[1], &xyz[2]};
            std::transform(plan->columns.begin(), plan->columns.end(), at.begin(),
                           [&](const PlanColumn& column) { return planes[column.channel].advanced(x); });
            collapse_run_reference(at, plan->weights, 1, to);
            PreviewSample sample;
            for (std::size_t c = 0; c < 3; ++c) {
                sample.xyz[c] = static_cast<double>(xyz[c]);
                sample.rgb[c] = sample_at(planes[channels.rgb[c]], x);
            }
            out.push_back(sample);
        }
    }
    return out;
}

std::vector<PreviewSample> preview_samples_of_file(const std::string& path, std::size_t part) {
    const auto file = exr::ExrFile::open(path);
    if (!file || part >= (*file)->parts().size())
        return {};
    const ChannelLayout& layout = (*file)->parts()[part].layout;
    const auto channels = PreviewChannels::find(layout);
    if (!channels)
        return {};
    image::PlaneChannels planes(layout.channel_names.size());
    for (const Band& band : channels->set.bands)
        planes[band.channel] = band.channel;
    for (const Reradiation& pair : channels->set.reradiation)
        planes[pair.channel] = pair.channel;
    for (const std::size_t channel : channels->rgb)
        planes[channel] = channel;
    const auto source = (*file)->make_block_source(part, planes, image::Grain::Block);
    if (!source)
        return {};
    const auto reader = (*source)->start_reader();
    if (!reader)
        return {};
    std::vector<PreviewSample> out;
    const std::size_t blocks = (*source)->block_count();
    const std::size_t step = (blocks + kMostBlocks - 1) / kMostBlocks;
    for (std::size_t block = step / 2; block < blocks; block += step) {
        const auto rows = (*reader)->read(block);
        if (!rows)
            return {};
        const auto samples = preview_samples(*channels, *rows);
        out.insert(out.end(), samples.begin(), samples.end());
    }
    return out;
}

}  // namespace osio::plugin
