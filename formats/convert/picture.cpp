// SPDX-License-Identifier: Apache-2.0
#include <formats/convert/picture.h>
#include <formats/image/derived_image.h>
#include <formats/image/preview_plan.h>

#include <algorithm>

namespace osio::convert {

Result<Choice> with_picture(Choice choice, const std::string& light) {
    const image::Part& part = choice.part();
    const std::vector<std::string> names = picture_names(choice.set.root);
    const std::vector<std::string> own = image::derived_names(part);
    std::vector<image::DerivedChannel> channels;
    std::vector<image::Channel> described;
    for (const std::size_t channel : choice.channels)
        if (std::find(names.begin(), names.end(), part.channels[channel].name) == names.end()) {
            described.push_back(part.channels[channel]);
            described.back().name = own[channel];
            channels.push_back({described.back(), channel, {}});
        }
    // The plan is that of the file that is written: of the bands that stay and of what is still said of them.
    const image::Part written = image::described_part(std::move(described), choice.attributes);
    auto plan = image::preview_plan(*written.layout.find_set(choice.set.name()), written.metadata, light);
    if (!plan)
        return fail_in(choice.image->path(), std::move(plan).error());
    for (std::size_t row = 0; row < names.size(); ++row) {
        image::DerivedChannel sum{{names[row], SampleType::Float, false}, std::nullopt, {}};
        // All bands, in the plan's order: the sums are a collapse's to the last bit.
        for (std::size_t band = 0; band < plan->bands.size(); ++band)
            sum.terms.push_back(
                {channels[plan->bands[band].channel].source.value(), plan->weights.at(row, band)});
        channels.push_back(std::move(sum));
    }
    image::insert_preview_attributes(*plan, choice.attributes);
    const std::size_t count = channels.size();
    Choice out;
    out.image = image::derive_image(choice.image, choice.part_index, std::move(channels), choice.attributes);
    for (std::size_t channel = 0; channel < count; ++channel)
        out.channels.push_back(channel);
    out.set = *out.part().layout.find_set(choice.set.name());
    out.attributes = choice.attributes;
    out.lost = choice.lost;
    return out;
}

}  // namespace osio::convert
