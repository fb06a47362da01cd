// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/all_parts.h>
#include <formats/convert/exr_parts.h>
#include <formats/convert/joined_rows.h>

#include <OpenEXR/ImfHeader.h>

#include <algorithm>
#include <numeric>

namespace osio::convert {

namespace {

/// A part that goes over, and how it is stored.
struct Whole {
    Choice choice;
    PartPlan plan;
};

bool has_planes(const image::Part& part) {
    return !part.deep && std::none_of(part.channels.begin(), part.channels.end(),
                                      [](const image::Channel& channel) { return channel.subsampled; });
}

Result<Whole> whole_part(const Request& request, const std::shared_ptr<const image::SpectralImage>& image,
                         std::size_t index, Outcome& outcome) {
    Choice choice;
    choice.image = image;
    choice.part_index = index;
    const image::Part& part = choice.part();
    choice.attributes = attributes_of(part);
    choice.channels.resize(part.channels.size());
    std::iota(choice.channels.begin(), choice.channels.end(), std::size_t{0});
    add_unique(part.layout.warnings, outcome.warnings);
    add_unique(part.metadata.warnings, outcome.warnings);
    PartPlan plan;
    plan.part.channels = stored_channels(request, choice, outcome);
    OSIO_TRY(plan.part.header, stored_header(request, choice, plan.part.channels));
    if (!plan.part.header.hasName())
        plan.part.header.setName("part " + std::to_string(index));
    plan.planes = choice.channels;
    return Whole{std::move(choice), std::move(plan)};
}

void count(const image::Part& part, Outcome& outcome) {
    if (outcome.bands == 0) {
        outcome.width = part.data_window.width();
        outcome.height = part.data_window.height();
    }
    for (const SpectralSet& set : part.layout.sets)
        outcome.bands += set.bands.size();
}

}  // namespace

bool takes_all_parts(const Request& request, const Target& target, const image::SpectralImage& image) {
    const bool chooses =
        !request.joined.empty() || !request.part.empty() || !request.set.empty() || request.split;
    const bool changes =
        request.bands || request.resampling || !request.preview.empty() || request.multi_part;
    return target.open == open_exr && image.parts().size() > 1 && !chooses && !changes &&
           std::any_of(image.parts().begin(), image.parts().end(),
                       [](const image::Part& part) { return has_planes(part) && !part.layout.sets.empty(); });
}

Result<void> write_all_parts(const Request& request, const std::shared_ptr<const image::SpectralImage>& image,
                             Runner& runner, const Progress& progress, Outcome& outcome) {
    std::vector<Whole> parts;
    std::vector<exr::OutputPart> outputs;
    for (std::size_t index = 0; index < image->parts().size(); ++index) {
        const image::Part& part = image->parts()[index];
        if (!has_planes(part)) {
            outcome.lost.push_back("part " + std::to_string(index) +
                                   (part.deep ? ", which is deep" : ", which is sub-sampled"));
            continue;
        }
        OSIO_TRY(Whole whole, whole_part(request, image, index, outcome));
        outputs.push_back(whole.plan.part);
        parts.push_back(std::move(whole));
        count(part, outcome);
    }
    OSIO_TRY(const auto writer, exr::ExrWriter::create(request.output, std::move(outputs)));
    for (std::size_t index = 0; index < parts.size(); ++index) {
        const Choice& choice = parts[index].choice;
        const image::Window& window = choice.part().data_window;
        const RowRange rows{window.min_y, window.max_y};
        OSIO_TRY(auto source,
                 image->make_block_source(choice.part_index, choice.planes(), image::Grain::Block));
        if (const int together = writer->rows_together(index); together > 0)
            source = regroup(std::move(source), rows, together);
        const auto start = [&] {
            return std::make_unique<Packing>(*writer, std::span(&parts[index].plan, 1), index,
                                             static_cast<std::size_t>(window.width()),
                                             outcome.clamped_samples);
        };
        const auto share = [&](double done) {
            return !progress ||
                   progress((static_cast<double>(index) + done) / static_cast<double>(parts.size()));
        };
        OSIO_CHECK_OK(visit_blocks(*source, rows, runner, start, share));
    }
    OSIO_CHECK_OK(writer->finish(request.durability));
    outcome.outputs.push_back(request.output);
    return {};
}

}  // namespace osio::convert
