// SPDX-License-Identifier: Apache-2.0
#include <formats/image/explain.h>

#include <osio/base/text.h>
#include <osio/collapse/pixel_stage.h>

#include <algorithm>
#include <set>

namespace osio::image {

namespace {

using Channels = std::set<std::size_t>;

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// "R, G, B", or the first, the last and how many there are.
std::string named(const std::vector<std::string>& names) {
    constexpr std::size_t kNamed = 6;
    if (names.size() <= kNamed)
        return join(names, ", ");
    return names.front() + " to " + names.back() + ", " + counted(names.size(), "channel");
}

/// Channels that are unpacked.
Channels read_channels(const CollapseJob& job) {
    Channels out;
    for (std::size_t column = 0; column < job.plan.columns.size(); ++column)
        if (job.plan.weights.needs(column))
            out.insert(job.plan.columns[column].channel);
    if (job.alpha)
        out.insert(*job.alpha);
    return out;
}

std::string why_unread(const CollapseJob& job, const SpectralSet& set) {
    const SpectralSet& chosen = job.set();
    const bool stokes = set.root == chosen.root && set.quantity() == chosen.quantity();
    if (stokes && !is_polarimetric(job.plan.space.kind))
        return job.plan.space.id + " is made of " + chosen.name() + " alone, whatever the polarisation";
    return job.plan.space.id + " is made of other bands";
}

void leave_out_channels(const CollapseJob& job, const Channels& read, std::vector<LeftOut>& out) {
    const Part& part = job.part();
    Channels planned;
    for (const PlanColumn& column : job.plan.columns)
        planned.insert(column.channel);
    std::vector<std::string> bands, pairs;
    for (std::size_t column = 0; column < job.plan.columns.size(); ++column)
        if (!job.plan.weights.needs(column))
            (job.plan.columns[column].emitted_nm ? pairs : bands)
                .push_back(part.channels[job.plan.columns[column].channel].name);
    if (!bands.empty())
        out.push_back(
            {named(bands), "the weight of " + counted(bands.size(), "band") + " is zero for every output"});
    if (!pairs.empty())
        out.push_back({named(pairs),
                       "no output sees what " + counted(pairs.size(), "pair") + " of reradiation send out"});

    for (const SpectralSet& set : part.layout.sets) {
        std::vector<std::string> names;
        for (const Band& band : set.bands)
            if (!planned.contains(band.channel))
                names.push_back(part.channels[band.channel].name);
        for (const Reradiation& pair : set.reradiation)
            if (!planned.contains(pair.channel))
                names.push_back(part.channels[pair.channel].name);
        if (!names.empty())
            out.push_back({"set " + set.name() + ": " + named(names), why_unread(job, set)});
    }
    std::vector<std::string> others;
    for (const std::size_t channel : part.layout.others)
        if (!read.contains(channel))
            others.push_back(part.channels[channel].name);
    if (!others.empty())
        out.push_back({named(others), "no bands"});
}

void leave_out_parts(const CollapseJob& job, std::vector<LeftOut>& out) {
    for (std::size_t index = 0; index < job.file->parts().size(); ++index)
        if (index != job.part_index) {
            const Part& part = job.file->parts()[index];
            out.push_back({"part " + std::to_string(index) +
                               (part.name.empty() ? "" : " \"" + part.name + "\"") + ": " +
                               counted(part.channels.size(), "channel"),
                           "the bands are in part " + std::to_string(job.part_index)});
        }
}

void leave_out_outputs(const CollapseJob& job, std::vector<LeftOut>& out) {
    if (job.plan.space.kind == SpaceKind::Luminance)
        out.push_back({"X and Z", "luminance is Y alone: one sum a pixel, not three"});
}

std::uint64_t area(const Window& window) {
    return static_cast<std::uint64_t>(window.width()) * static_cast<std::uint64_t>(window.height());
}

void leave_out_pixels(const CollapseJob& job, std::vector<LeftOut>& out) {
    const Window &data = job.part().data_window, &display = job.part().display_window;
    const Window common{std::max(data.min_x, display.min_x), std::max(data.min_y, display.min_y),
                        std::min(data.max_x, display.max_x), std::min(data.max_y, display.max_y)};
    const bool overlap = common.min_x <= common.max_x && common.min_y <= common.max_y;
    const std::uint64_t missing = area(display) - (overlap ? area(common) : 0);
    if (missing > 0)
        out.push_back({std::to_string(missing) + " of " + std::to_string(area(display)) +
                           " pixels of the display window",
                       "the data window ends before them: nothing is read or written there"});
}

Step curve_step(const CollapsePlan& plan) {
    const OutputSpace& space = plan.space;
    if (is_polarisation(space.kind))
        return {"curve", space.id + " of the Stokes components, pixel by pixel"};
    if (space.transform)
        return {"curve", "the config's transform from " + space.transform->source().from + " to " + space.id};
    if (!PixelStage(space, plan.white).needed())
        return {"curve", space.id + " is linear", true};
    if (space.transfer != Transfer::Linear)
        return {"curve", "IEC 61966-2-1's"};
    return {"curve", "from X, Y, Z to " + join(plan.outputs, ", ")};
}

/// True where values refer to the space's own white already, to the last digit.
bool is_adapted_already(const CollapsePlan& plan) {
    const Vector3 white = plan.space.white.xyz(), &from = *plan.adapted_from;
    return plan.space.kind != SpaceKind::Display && white[0] == from[0] && white[1] == from[1] &&
           white[2] == from[2];
}

/// What costs nothing a pixel, since it is in the weights.
std::vector<Step> folded_steps(const CollapsePlan& plan) {
    const std::string folded = ", in the weights";
    std::vector<Step> out;
    out.push_back(plan.filters.empty() ? Step{"filters", "none", true}
                                       : Step{"filters", counted(plan.filters.size(), "filter") + folded});
    if (!plan.adapted_from)
        out.push_back({"adaptation", "none: values refer to the white that they have", true});
    else if (is_adapted_already(plan))
        out.push_back({"adaptation", "none: the white is the space's own", true});
    else
        out.push_back({"adaptation", std::string(adaptation_name(plan.request.adaptation)) + folded});
    out.push_back(plan.request.exposure_stops == 0
                      ? Step{"exposure", "0 stops", true}
                      : Step{"exposure", format_double(plan.request.exposure_stops) + " stops" + folded});
    return out;
}

}  // namespace

Explanation explain(const CollapseJob& job) {
    const Part& part = job.part();
    const CollapsePlan& plan = job.plan;
    const Channels read = read_channels(job);
    Explanation out;
    out.pixels = area(part.data_window);
    out.samples = out.pixels * read.size();
    for (const std::size_t channel : read)
        out.sample_bytes += out.pixels * sample_bytes(part.channels[channel].type);
    std::size_t weights = 0;
    for (std::size_t row = 0; row < plan.weights.rows(); ++row)
        weights += static_cast<std::size_t>(std::count_if(
            plan.weights.row(row).begin(), plan.weights.row(row).end(), [](double w) { return w != 0; }));
    out.products = out.pixels * weights;

    out.steps.push_back({"read", std::to_string(read.size()) + " of " +
                                     counted(part.channels.size(), "channel") + " of part " +
                                     std::to_string(job.part_index)});
    out.steps.push_back({"sum", counted(plan.weights.rows(), "output") + " of " +
                                    counted(plan.columns.size(), "column") + ", " +
                                    counted(weights, "weight")});
    for (Step& step : folded_steps(plan))
        out.steps.push_back(std::move(step));
    out.steps.push_back(curve_step(plan));
    out.steps.push_back(job.alpha ? Step{"alpha", part.channels[*job.alpha].name + " passes through"}
                                  : Step{"alpha", "the image has none", true});
    out.steps.push_back({"write", join(job.channel_names(), ", ")});

    leave_out_channels(job, read, out.left_out);
    leave_out_parts(job, out.left_out);
    leave_out_outputs(job, out.left_out);
    leave_out_pixels(job, out.left_out);
    return out;
}

}  // namespace osio::image
